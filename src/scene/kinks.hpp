#pragma once
#include <array>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

// Marks the entries at which the function bends so sharply that Quadrature::cells splits the ray
// there, because the slope of the extinction, or of the colour times the opacity, changes by more
// than 2⁻¹⁵ per entry. Beyond its ends the function is constant. Without a split at a kink of bend
// q, the two-point Gauss rule has an error of at most 0.0224·q·Δ per voxel, where Δ is the number
// of entries that the piece spans. For a smooth function, the bends cause no such error, because
// the rule follows the curve.
[[nodiscard]] std::array<bool, 256> kinks(const TransferFunction& function);

}  // namespace triptych::scene
