#pragma once
// Distinguishes records that have an image to judge from others.

#include "record/record.hpp"

namespace triptych::record {

// speed_of_light leaves sums instead of an image, and where only compilers were asked, nothing was
// drawn. A record knows only the name of its technique; a test compares it with the catalogue,
// which lists the techniques without a picture.
[[nodiscard]] inline bool has_picture(const Record& record) {
  return record.technique != "speed_of_light" && record.code.empty();
}

}  // namespace triptych::record
