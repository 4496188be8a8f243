#pragma once
// Denormal floats cost processors that keep them a hundred cycles each, and others take them for 0.
// What goes to a device has none: they are 0 before, which changes no value by as much as 2⁻¹²⁶.

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
