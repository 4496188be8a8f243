#pragma once
// The hashes of a reference image. They are stored instead of the image, which is much larger.

#include <array>
#include <string>

#include "core/image.hpp"

namespace triptych::judge {

// Two hashes of the quantized colour values of an image. Each hash uses its own grid of
// quantization cells. The cells of both grids have the width q = 1/4096, and the grids are offset
// by half a cell. A different math library changes a colour value by about δ = 1e-13 (an ulp or two
// in each of a few hundred steps). On one grid, the probability that at least one of N colour
// values moves to another cell is 2Nδ/q, or 1e-3 for an image of 512² pixels; the probability that
// this happens on both grids is the square of that. q is smaller than the error bound of any pixel,
// so a change that a check could detect changes both hashes. Depths and ids are not hashed, because
// at an edge they depend on the last bit, and because the hashed colours already depend on which
// surface is visible.
using ReferenceHash = std::array<std::string, 2>;
[[nodiscard]] ReferenceHash reference_hash(const core::Image& image);
// Returns whether the hashes for at least one of the grids are equal.
[[nodiscard]] bool is_same_reference(const ReferenceHash& a, const ReferenceHash& b);

}  // namespace triptych::judge
