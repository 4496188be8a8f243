#pragma once
#include <array>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

// Returns, for each entry, whether the function has a kink there. Quadrature::cells, a rule that
// integrates along the ray (volume_scene.hpp), must split the ray at kinks. An entry is a kink if
// the slope of the extinction (the optical depth per voxel length) changes there by more than 2⁻¹⁵,
// or if the change in the slope of a colour channel, multiplied by the opacity, exceeds 2⁻¹⁵.
// Slopes are differences between adjacent entries. The function is constant before the first entry
// and after the last entry. If a piece of the ray is not split where the slope changes by q, the
// two-point Gauss rule integrates it with an error of at most 0.0224·q·Δ for each voxel of the
// length of the piece, where Δ is the number of entries between the values at the two ends of the
// piece. A smooth function does not cause this error, even where its slope changes, because the
// Gauss rule follows the curve.
[[nodiscard]] std::array<bool, 256> kinks(const TransferFunction& function);

}  // namespace triptych::scene
