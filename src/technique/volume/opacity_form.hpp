#pragma once
#include <cmath>

namespace triptych::technique {

// Returns the argument `form` of tri_opacity_by_form (portable/volume_math.h) for a step. The forms
// k = 1, 2, 3 and 4 are for steps of 2^(1−k) = 1, ½, ¼ and ⅛ voxels, and the forms k = −1 and −2
// are for steps of 2^−k = 2 and 4 voxels. They are formulas with square roots or squares, which are
// much cheaper than a logarithm and an exponential. For any other step, the form is 0, the general
// formula. Smaller and larger powers of two also have the form 0, because more than three square
// roots or two squares would be as slow as the general formula and less accurate. Kernels receive
// the form as a compile-time constant (TRI_OPACITY_FORM).
[[nodiscard]] inline int opacity_form(double step_voxels) {
  int exponent = 0;
  if (std::frexp(step_voxels, &exponent) != 0.5) return 0;
  const int log2_step = exponent - 1;
  if (log2_step > 0) return log2_step <= 2 ? -log2_step : 0;
  return log2_step >= -3 ? 1 - log2_step : 0;
}

}  // namespace triptych::technique
