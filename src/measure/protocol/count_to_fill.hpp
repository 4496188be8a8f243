#pragma once

#include <algorithm>
#include <cmath>

namespace triptych::measure {

// Returns the number of repetitions that fill a period of `ns`, if each repetition takes `each_ns`.
// The result is between 1 and `most`. If `each_ns` is 0, because the clock is too coarse, the
// result is `most`.
[[nodiscard]] inline int count_to_fill(double ns, double each_ns, int most) {
  if (!(each_ns > 0)) return most;
  const double count = std::ceil(ns / each_ns);
  return count < most ? std::max(1, static_cast<int>(count)) : most;
}

}  // namespace triptych::measure
