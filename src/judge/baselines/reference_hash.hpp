#pragma once
// What is kept of a reference picture where the picture itself is not.

#include <array>
#include <string>

#include "core/image.hpp"

namespace triptych::judge {

// Two hashes of the colours, cut into cells of q = 1/4096 on two grids half a cell apart.
// Another libm moves a colour by δ of some 1e-13 (an ulp or two, through a few hundred steps). On
// one grid one of N colours would then fall into another cell with probability 2Nδ/q, 1e-3 for a
// picture of 512²; on both grids at once only with the square of that. q is below any bound that a
// picture's pixel is held to, so a pixel that changes by what a check could see changes both. Depth
// and id are left out: at an edge they turn over with the last bit, and what they show has a
// colour.
using ReferenceHash = std::array<std::string, 2>;
[[nodiscard]] ReferenceHash reference_hash(const core::Image& image);
// Equal on one of the grids.
[[nodiscard]] bool is_same_reference(const ReferenceHash& a, const ReferenceHash& b);

}  // namespace triptych::judge
