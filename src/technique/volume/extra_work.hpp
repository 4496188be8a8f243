#pragma once
// The grid of a planted slowdown by real work.

namespace triptych::technique {

// Rows of a grid whose rows tri_drawn_row (portable/volume_math.h) maps to a share of 1/stride of
// an image, each drawn a second time; none for stride 0.
[[nodiscard]] constexpr int extra_rows(int height, int stride) {
  constexpr int band = 8;
  return stride == 0 ? 0 : (height + band * stride - 1) / (band * stride) * band;
}

}  // namespace triptych::technique
