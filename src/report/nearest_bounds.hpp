#pragma once
// How near pictures come to their bounds. A bound that no picture comes near sees little.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// One device in one plan.
struct NearestBound {
  std::string plan;
  std::string device;
  std::size_t pictures = 0;
  double share = 0;  // the largest of an error over its bound, of all pixels; beyond 1 it is wrong
  std::string configuration;  // where
};

// By plan, then by device. Text of unknown origin.
[[nodiscard]] std::vector<NearestBound> nearest_bounds(
    std::span<const judge::GateResult* const> results);

// "nearest 0.61 of it; 0.0031 on gl:x in volume/quick": the nearest of all, and the device and plan
// that stay farthest away where that is less than a hundredth. Empty where there are no pictures.
[[nodiscard]] std::string nearest_text(std::span<const NearestBound> bounds);

}  // namespace triptych::report
