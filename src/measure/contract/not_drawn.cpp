#include "measure/contract/not_drawn.hpp"

#include <algorithm>

namespace triptych::measure {

void check_counted(std::span<const std::uint32_t> counters) {
  const bool untouched = !counters.empty() && std::ranges::all_of(counters, [](std::uint32_t each) {
    return each == poison_word;
  });
  if (untouched) {
    throw NotDrawn(
        "the frame that counts was not drawn: the driver reported it as finished, and its counters "
        "still hold what they were filled with before it");
  }
}

}  // namespace triptych::measure
