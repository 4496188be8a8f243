#pragma once
// Reports how close the errors of images come to their bounds. If no image comes close to a bound,
// that bound is a weak test.

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
  double share = 0;  // the largest ratio of an error to its bound over all pixels; above 1 the
                     // image is wrong
  std::string configuration;  // the configuration of that pixel
};

// Sorted by plan, then by device. The texts are of unknown origin and must be escaped.
[[nodiscard]] std::vector<NearestBound> nearest_bounds(
    std::span<const judge::GateResult* const> results);

// "at most 0.61 of the bound, only 0.0031 on gl:x in volume/quick": the largest share of all, and then
// the device and plan with the smallest share if it is below a hundredth. Empty if there are no
// images.
[[nodiscard]] std::string nearest_text(std::span<const NearestBound> bounds);

}  // namespace triptych::report
