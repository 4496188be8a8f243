#pragma once
// Computes the opacity of a step from the opacity per voxel length.

#include "reference/table.hpp"

namespace triptych::reference {

// Returns 1 − (1 − alpha)^steps without cancellation: 0 for steps ≤ 0, and 1 for alpha = 1.
[[nodiscard]] double step_opacity(double alpha, double steps);

// The length that a sample covers, in voxel lengths, and the smallest and largest length that it
// may cover on a device.
struct StepLength {
  double nominal = 1;
  double shortest = 1;
  double longest = 1;
};

// The opacity of a sample, and the smallest and largest opacity that it may have on a device.
struct StepOpacity {
  double nominal = 0;
  double lo = 0;
  double hi = 0;
};

// Returns the opacity of a sample. The bounds are valid even if the derivative of the opacity is
// unbounded (near alpha = 1 with steps < 1), and if the sample exists on some devices but not on
// others (its shortest length is 0). `relative_error` is the error of the device's own opacity
// correction.
[[nodiscard]] StepOpacity step_opacity(const TableLookup& lookup, const StepLength& steps,
                                       double relative_error);

}  // namespace triptych::reference
