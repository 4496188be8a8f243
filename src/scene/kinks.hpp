#pragma once
#include <array>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

// The entries at which the function bends so sharply that Quadrature::cells cuts there: by more
// than 2⁻¹⁵ per entry in extinction, or in colour times opacity. Beyond its ends the function is
// constant. At a kink of bend q without a cut, Gauss's rule of two points is off by at most
// 0.0224·q·Δ per voxel, where Δ is the number of entries that the piece spans. The errors of a
// smooth function cancel, because the rule follows its curve.
[[nodiscard]] std::array<bool, 256> kinks(const TransferFunction& function);

}  // namespace triptych::scene
