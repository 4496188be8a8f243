#pragma once
// Distinguishes records that have an image to be compared from records that have none.

#include "record/record.hpp"

namespace triptych::record {

// Returns whether the record has an image. There is no image if the technique is speed_of_light,
// which only fetches the data and sums them, or if the device is a compile-only device, which draws
// nothing. A test compares this function with technique/catalogue.hpp, which states for each
// technique whether it draws an image.
[[nodiscard]] inline bool has_image(const Record& record) {
  return record.technique != "speed_of_light" && record.code.empty();
}

}  // namespace triptych::record
