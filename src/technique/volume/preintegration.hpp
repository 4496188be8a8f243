#pragma once
// The look-up table for quadrature=preintegrated (portable/volume_preintegration.h).

#include <array>
#include <vector>

#include "scene/transfer_function.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::technique {

// For each pair of the 256 entries of the transfer function, the table describes the path that runs
// linearly from the first entry to the second. The path consists of whole cells, where a cell is
// the interval between two adjacent entries. The pair (from, to) is at index
// texels_per_pair·(256·from + to):
//   [0] = (depth, a0), [1] = (a1, 0), [2] = (a2, 0).
// `depth` is the sum, over all cells of the path, of the mean of −log2(1 − alpha) in the cell.
// Multiplied by the length of a cell in voxels, it is the optical depth in powers of two: a depth d
// transmits 2^−d of the light. a0, a1 and a2 are the first Legendre coefficients of the colour as a
// function of the share of the depth that the light has passed. For a path without any depth, they
// represent the colour of the entry `from`. An entry of opacity 1 counts as an optical depth of
// 8192 per voxel length, so that 1/64 voxel length hides everything behind it. The table is
// computed in double precision, so its only error is the rounding to float. It depends on the
// transfer function but not on the step.
inline constexpr std::size_t texels_per_pair = 3;
[[nodiscard]] std::vector<std::array<float, 4>> preintegrated_pairs(
    const scene::TransferFunction& function);

// Returns the value of TRI_PREINTEGRATED for the raycasters: 0 if the quadrature of the scene is
// not `preintegrated`, 1 if all whole cells of any step can be processed at once, or 2 if their
// optical depth may be too large for that (TRI_DEEPEST_CHUNK).
[[nodiscard]] int preintegration_form(const scene::VolumeScene& scene);

}  // namespace triptych::technique
