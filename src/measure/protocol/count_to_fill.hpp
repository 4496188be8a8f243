#pragma once

#include <algorithm>
#include <cmath>

namespace triptych::measure {

// The number of repetitions of `each_ns` that last `ns`, between 1 and `most`. If the clock is too
// coarse to measure one, the result is `most`.
[[nodiscard]] inline int count_to_fill(double ns, double each_ns, int most) {
  if (!(each_ns > 0)) return most;
  const double count = std::ceil(ns / each_ns);
  return count < most ? std::max(1, static_cast<int>(count)) : most;
}

}  // namespace triptych::measure
