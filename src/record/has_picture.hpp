#pragma once
// Distinguishes records that have an image to compare from records without one.

#include "record/record.hpp"

namespace triptych::record {

// The technique speed_of_light computes sums instead of an image, and a compile-only device draws
// nothing. A record contains only the name of its technique, so a test compares that name with the
// catalogue, which lists the techniques without an image.
[[nodiscard]] inline bool has_picture(const Record& record) {
  return record.technique != "speed_of_light" && record.code.empty();
}

}  // namespace triptych::record
