#pragma once
// Which bricks a ray may cross with a single sample, within a stated error: RaycastOptions::adapt.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "technique/volume/bricks.hpp"

namespace triptych::technique {

// What a ray does in a brick. The numbers are those of the kernels.
enum class BrickKind : std::int32_t {
  invisible = 0,  // skips it
  sampled = 1,    // takes the samples of the lattice
  merged = 2,     // takes one sample in the middle of its way, with the opacity of all of it (V1)
  // From here on a number for each value that fills homogeneous bricks. All of a ray's bricks in
  // succession with the same number are merged into one sample.
  homogeneous = 3
};

// A BrickKind per brick: the visible ones (brick_visibility) are merged where that moves no channel
// of any pixel by more than `adapt`, all merged bricks of a ray together.
//
// Let a ray cross merged bricks with the opacities A' and the transmittances T' in front, over the
// lengths l. With a ≤ b the extremes of extinction per voxel in a brick, w the range of its
// colours, and R that of all colours that there may be, one crossing moves the picture by at most
// (reference/composite.hpp's identity)
//   T'·(R·|ΔA| + w·A'),   |ΔA| ≤ e^(−al) − e^(−bl) ≤ (b − a)·l·e^(−al).
// Two facts bound the sum along the ray: Σ T'·A' ≤ 1, and Σ l ≤ L, the longest way through the
// volume. So half the budget, K = adapt/2, is given to what is opaque and half, Y = adapt/2L, to
// each voxel of the way. As l·a·e^(−al) ≤ 1 − e^(−al) ≤ A' and A' ≤ b·l, what is within
//   R·(b − a) + (w − k)·b ≤ (K − k)·a + Y,   k = min(w, K),
// costs at most K·T'·A' + Y·l, which sums to adapt. A homogeneous brick costs nothing, whatever l
// is: so do many of one value together.
//
// Both pictures are a device's own: values that it finds in a brick lie within the brick's range
// and the rounding of its interpolation (16·2⁻²⁴ of the largest value; none between equal voxels),
// by which the range is widened. `ranges` as of brick_layout(scene, Skip::bricks, adapt).
//
// The extremes of the transfer function over any range of values take O(1) by a sparse table
// (Bender & Farach-Colton 2000) made once per function.
[[nodiscard]] std::vector<std::int32_t> brick_kinds(const BrickRanges& ranges,
                                                    const scene::VolumeScene& scene, double adapt);

// Why the technique cannot merge bricks of this scene; empty where it can or need not.
[[nodiscard]] std::optional<std::string> adapt_reason(std::string_view technique,
                                                      const scene::VolumeScene& scene,
                                                      const RaycastOptions& options);

}  // namespace triptych::technique
