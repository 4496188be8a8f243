#pragma once
#include <cmath>

namespace triptych::technique {

// Returns the `form` of tri_opacity_by_form (portable/volume_math.h) for a step: k > 0 for 2^(1−k)
// voxels, k < 0 for 2^−k voxels, and 0 for any other step. Kernels receive it as a compile-time
// constant (TRI_OPACITY_FORM), because square roots and squares are much cheaper than a logarithm
// and an exponential. If more than three square roots or two squares would be necessary, the
// general form is as fast and more accurate.
[[nodiscard]] inline int opacity_form(double step_voxels) {
  int exponent = 0;
  if (std::frexp(step_voxels, &exponent) != 0.5) return 0;
  const int log2_step = exponent - 1;
  if (log2_step > 0) return log2_step <= 2 ? -log2_step : 0;
  return log2_step >= -3 ? 1 - log2_step : 0;
}

}  // namespace triptych::technique
