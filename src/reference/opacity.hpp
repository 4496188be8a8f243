#pragma once
// Opacity of a step from the opacity of one voxel length.

#include "reference/table.hpp"

namespace triptych::reference {

// 1 − (1 − alpha)^steps without cancellation; 0 for steps ≤ 0, 1 for alpha = 1.
[[nodiscard]] double step_opacity(double alpha, double steps);

// Steps a sample stands for, in voxel lengths, and the least and most a device may take.
struct StepLength {
  double nominal = 1;
  double shortest = 1;
  double longest = 1;
};

// A sample's opacity, and the least and most a device may find.
struct StepOpacity {
  double nominal = 0;
  double lo = 0;
  double hi = 0;
};

// Rigorous also where the derivative is not: near alpha = 1 with steps < 1, and where a whole step
// appears or vanishes. `relative_error` is that of the device's own correction.
[[nodiscard]] StepOpacity step_opacity(const Looked& looked, const StepLength& steps,
                                       double relative_error);

}  // namespace triptych::reference
