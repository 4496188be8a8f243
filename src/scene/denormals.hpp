#pragma once
// Some CPUs and GPUs need about a hundred cycles for each operation on a denormal float, and others
// treat denormals as 0. Therefore denormals are set to 0 before data are sent to a device. This
// changes each value by less than 2⁻¹²⁶.

#include <cmath>
#include <limits>

#include "scene/transfer_function.hpp"

namespace triptych::scene {

[[nodiscard]] inline float without_denormal(float value) {
  return std::abs(value) < std::numeric_limits<float>::min() ? 0.0F : value;
}

[[nodiscard]] inline TransferFunction without_denormals(TransferFunction function) {
  for (auto& entry : function.entries) {
    for (float& value : entry) value = without_denormal(value);
  }
  return function;
}

}  // namespace triptych::scene
