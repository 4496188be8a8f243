#pragma once
// Decides which bricks a ray may cross with a single sample, within an allowed error
// (RaycastOptions::adapt).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "technique/volume/bricks.hpp"

namespace triptych::technique {

// How a ray treats a brick. The kernels use the same numeric values.
enum class BrickKind : std::int32_t {
  invisible = 0,  // the ray skips the brick
  sampled = 1,    // the ray takes its regular samples
  merged = 2,  // the ray takes one sample in the middle of its path through the brick; the sample
               // has the opacity of this path
  // This and all larger numbers denote homogeneous bricks; each number stands for one value.
  // Consecutive bricks along a ray with the same number are merged into one sample.
  homogeneous = 3
};

// Returns a BrickKind for each brick. The samples in a visible brick (brick_visibility) are merged
// if the brick satisfies a bound. The bound ensures that merging all such bricks along a ray
// changes no channel of any pixel by more than `adapt`.
//
// Derivation. Let a ray cross merged bricks. For each crossing, l is its length in voxels, A' is
// its opacity, and T' is the transmittance in front of it. a ≤ b are the smallest and the largest
// extinction per voxel length in the brick, and w is the range of its colours. R is the range of
// all possible colours, and ΔA is the change of A' that is caused by merging. By the identity in
// reference/composite.hpp, one crossing changes the image by at most
//   T'·(R·|ΔA| + w·A'),   |ΔA| ≤ e^(−al) − e^(−bl) ≤ (b − a)·l·e^(−al).
// Two facts bound the sum along the ray: Σ T'·A' ≤ 1, and Σ l ≤ L, where L is the longest chord of
// the volume in voxels. Therefore one half of the permitted change, K = adapt/2, is distributed in
// proportion to opacity, and the other half in proportion to length, with Y = adapt/(2·L) for each
// voxel length. Because l·a·e^(−al) ≤ 1 − e^(−al) ≤ A' and A' ≤ b·l, a brick that satisfies
//   R·(b − a) + (w − k)·b ≤ (K − k)·a + Y,   k = min(w, K),
// changes the image by at most K·T'·A' + Y·l: if w ≤ K, then k = w and the term with b is 0;
// otherwise, k = K and the term with a is 0. Along a ray, the sum of these changes is at most
// `adapt`. A homogeneous brick changes nothing for any l, and neither do several consecutive bricks
// with the same value.
//
// The derivation compares images of the same device with and without merging. The values that the
// device interpolates in a brick are within the brick's range, widened by the rounding of its
// interpolation (16·2⁻²⁴ of the largest value; no rounding between equal voxels). `ranges` are the
// ranges for brick_layout(scene, Skip::bricks, adapt).
//
// Finding the extremes of the transfer function over a range of values takes O(1), because of a
// sparse table (Bender & Farach-Colton 2000) that is computed once for each function.
[[nodiscard]] std::vector<std::int32_t> brick_kinds(const BrickRanges& ranges,
                                                    const scene::VolumeScene& scene, double adapt);

// Returns why the technique cannot merge samples in this scene, or nullopt if it can or if `adapt`
// is 0.
[[nodiscard]] std::optional<std::string> adapt_reason(std::string_view technique,
                                                      const scene::VolumeScene& scene,
                                                      const RaycastOptions& options);

}  // namespace triptych::technique
