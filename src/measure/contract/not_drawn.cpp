#include "measure/contract/not_drawn.hpp"

#include <algorithm>

namespace triptych::measure {

void check_counted(std::span<const std::uint32_t> counters) {
  const bool untouched = !counters.empty() && std::ranges::all_of(counters, [](std::uint32_t each) {
    return each == poison_word;
  });
  if (untouched) {
    throw NotDrawn(
        "the frame with Triptych's counters was not drawn: all counters still contain the fill "
        "value that was written before the frame");
  }
}

}  // namespace triptych::measure
