#pragma once
// Distinguishes records that have an image to be compared from records that have none.

#include "record/record.hpp"

namespace triptych::record {

// Returns whether the record has an image. There is no image for the technique speed_of_light,
// which only computes sums, and for a compile-only device, which draws nothing. A test compares the
// technique's name with the catalogue, which lists the techniques that draw no image.
[[nodiscard]] inline bool has_picture(const Record& record) {
  return record.technique != "speed_of_light" && record.code.empty();
}

}  // namespace triptych::record
