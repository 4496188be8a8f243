#include "scene/kinks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace triptych::scene {
namespace {

constexpr double sharp = 0x1.0p-15;

}  // namespace

std::array<bool, 256> kinks(const TransferFunction& function) {
  const auto& entries = function.entries;
  const std::size_t last = entries.size() - 1;
  std::array<bool, 256> found{};
  for (std::size_t k = 0; k <= last; ++k) {
    const auto& entry = entries[k];
    const auto bend = [&](std::size_t channel) {
      const double middle = static_cast<double>(entry[channel]);
      const double before = static_cast<double>(entries[k == 0 ? 0 : k - 1][channel]);
      const double after = static_cast<double>(entries[std::min(k + 1, last)][channel]);
      return std::abs(before - 2 * middle + after);
    };
    const double alpha = static_cast<double>(entry[3]);
    // Both sides of this comparison are multiplied by 1 − alpha, because the slope of the
    // extinction −ln(1 − alpha) is the slope of alpha divided by 1 − alpha.
    const bool extinction = bend(3) > sharp * (1 - alpha);
    const bool colour = std::max({bend(0), bend(1), bend(2)}) * alpha > sharp;
    found[k] = extinction || colour;
  }
  return found;
}

}  // namespace triptych::scene
