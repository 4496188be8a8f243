#pragma once

#include <cmath>
#include <numbers>

#include "core/random.hpp"

namespace triptych::test {

// Returns a random number with the standard normal distribution, computed with the Box–Muller
// transform.
inline double normal(core::Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
  return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

}  // namespace triptych::test
