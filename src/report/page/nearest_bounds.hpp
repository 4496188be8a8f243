#pragma once
// Reports how close the errors of images come to their error bounds. If no image comes close to its
// bound, the bound is a weak test.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// The result for one device in one plan.
struct NearestBound {
  std::string plan;
  std::string device;
  std::size_t images = 0;
  double share = 0;  // largest ratio of an error to its bound, over all pixels of correct images
  std::string configuration;  // the configuration with this ratio
};

// Returns the results in the order of the plans, and for each plan by device. Callers must escape
// the names.
[[nodiscard]] std::vector<NearestBound> nearest_bounds(
    std::span<const judge::GateResult* const> results);

// Returns "error / bound ≤ 0.61 (≤ 0.0031 on gl:x in volume/quick)": the largest share and,
// if it is below 0.01, the smallest share with its device and plan. Returns "" if there are no
// images.
[[nodiscard]] std::string nearest_text(std::span<const NearestBound> bounds);

}  // namespace triptych::report
