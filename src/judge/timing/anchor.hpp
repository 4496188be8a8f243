#pragma once
// Anchors: configurations that measure the device alone, so that a slower device can be told from a
// slower program. What they leave behind is sums, not pictures.

#include <string_view>

#include "record/record.hpp"

namespace triptych::judge {

// The plan whose runs hold nothing but anchors.
inline constexpr std::string_view anchors_plan = "anchors/frozen";

// By name, as a record is all there is: tests/unit/anchors holds it to the catalogue's techniques
// without a picture.
[[nodiscard]] inline bool is_anchor(const record::Record& record) {
  return record.technique == "speed_of_light" || record.suite == "anchors";
}

}  // namespace triptych::judge
