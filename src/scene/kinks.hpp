#pragma once
#include <array>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

// Returns, for each entry, whether the function has a kink there, so that Quadrature::cells must
// split the ray. An entry is a kink if the slope of the extinction, or of the colour times the
// opacity, changes by more than 2⁻¹⁵ per entry. The function is constant before the first entry and
// after the last entry. If the ray is not split where the slope changes by q, the two-point Gauss
// rule has an error of at most 0.0224·q·Δ per voxel, where Δ is the number of entries that the
// piece of the ray spans. A smooth function does not cause this error, even where its slope
// changes, because the Gauss rule follows the curve.
[[nodiscard]] std::array<bool, 256> kinks(const TransferFunction& function);

}  // namespace triptych::scene
