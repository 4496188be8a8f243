#pragma once
// What quadrature preintegrated looks up (portable/volume_preintegration.h).

#include <array>
#include <vector>

#include "scene/transfer_function.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::technique {

// A path that runs straight through whole cells of the transfer function, from one of its 256
// entries to another, for each pair of them: pair (from, to) is at texels_per_pair·(256·from + to),
//   [0] = (depth, a0), [1] = (a1, 0), [2] = (a2, 0).
// depth: −Σ log2(1 − alpha), averaged per cell: times the length that one cell takes, in voxels, it
// is the optical depth in powers of two. a0, a1, a2: colour over the share of the depth passed, its
// first Legendre coefficients; the colour of the entry `from` where there is no depth.
// An entry of opacity 1 counts as 8192 per voxel, which leaves nothing behind 1/64 voxel of it.
// Computed in double, so nothing but the rounding to float is lost; the table depends on the
// transfer function alone, not on the step.
inline constexpr std::size_t texels_per_pair = 3;
[[nodiscard]] std::vector<std::array<float, 4>> preintegrated_pairs(
    const scene::TransferFunction& function);

// The raycasters' TRI_PREINTEGRATED: 0 with another quadrature, 1 where all whole cells of any step
// may be taken at once, 2 where they may be too deep for that (TRI_DEEPEST_CHUNK).
[[nodiscard]] int preintegration_form(const scene::VolumeScene& scene);

}  // namespace triptych::technique
