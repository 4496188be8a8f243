#pragma once

#include <algorithm>
#include <cmath>

namespace triptych::measure {

// As many of `each_ns` as last `ns` together, one at least and `most` at most; a clock too coarse
// to see one asks for as many as there may be.
[[nodiscard]] inline int count_to_fill(double ns, double each_ns, int most) {
  if (!(each_ns > 0)) return most;
  const double count = std::ceil(ns / each_ns);
  return count < most ? std::max(1, static_cast<int>(count)) : most;
}

}  // namespace triptych::measure
