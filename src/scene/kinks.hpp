#pragma once
#include <array>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

// At which entries the function bends so sharply that Quadrature::cells cuts there: by more than
// 2⁻¹⁵ per entry in extinction, or in colour times opacity. Beyond its ends it is constant. A kink
// of bend q that is not cut at costs Gauss's rule of two points at most 0.0224·q·Δ per voxel, Δ the
// entries that the piece spans; those of a smooth function cancel, as the rule sees its curve.
[[nodiscard]] std::array<bool, 256> kinks(const TransferFunction& function);

}  // namespace triptych::scene
