#pragma once
// The hashes of a reference image, which are stored in place of the image itself.

#include <array>
#include <string>

#include "core/image.hpp"

namespace triptych::judge {

// Two hashes of the colours, rounded to cells of width q = 1/4096 on two grids that lie half a cell
// apart. Another math library moves a colour by δ, about 1e-13 (an ulp or two, through a few
// hundred steps). On one grid, the probability that at least one of N colours falls into another
// cell would be 2Nδ/q, 1e-3 for an image of 512² pixels; for both grids at once it is the square of
// that. q is smaller than every error bound of a pixel, so a change that a check could detect
// changes both hashes. Depths and ids are left out: at an edge they change with the last bit, and
// the surface that they describe also has a colour.
using ReferenceHash = std::array<std::string, 2>;
[[nodiscard]] ReferenceHash reference_hash(const core::Image& image);
// Whether the hashes are equal on one of the grids.
[[nodiscard]] bool is_same_reference(const ReferenceHash& a, const ReferenceHash& b);

}  // namespace triptych::judge
