#pragma once
// Distinguishes records that have an image to compare from records without one.

#include "record/record.hpp"

namespace triptych::record {

// Whether the record has an image. The technique speed_of_light computes sums instead of an image,
// and a compile-only device draws nothing. A test checks that the technique's name here agrees with
// the catalogue, which states the techniques that draw no image.
[[nodiscard]] inline bool has_picture(const Record& record) {
  return record.technique != "speed_of_light" && record.code.empty();
}

}  // namespace triptych::record
