#pragma once
// Anchors: configurations that measure the device alone, so that a slower device can be told from a
// slower program. What they leave behind is sums, not pictures.

#include "record/record.hpp"

namespace triptych::judge {

[[nodiscard]] inline bool is_anchor(const record::Record& record) {
  return record.technique == "speed_of_light" || record.suite == "anchors";
}

}  // namespace triptych::judge
