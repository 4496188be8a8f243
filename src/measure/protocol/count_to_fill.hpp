#pragma once

#include <algorithm>
#include <cmath>

namespace triptych::measure {

// Returns how many repetitions that take `each_ns` fill `ns`, limited to 1 to `most`. If `each_ns`
// is 0, because the clock is too coarse, the result is `most`.
[[nodiscard]] inline int count_to_fill(double ns, double each_ns, int most) {
  if (!(each_ns > 0)) return most;
  const double count = std::ceil(ns / each_ns);
  return count < most ? std::max(1, static_cast<int>(count)) : most;
}

}  // namespace triptych::measure
