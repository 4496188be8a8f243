#pragma once
// Which records have an image that can be judged.

#include "record/record.hpp"

namespace triptych::record {

// What speed_of_light leaves behind is sums, and where only compilers were asked nothing was drawn. By name, as a record is all there is: the test holds
// it to the catalogue's techniques without a picture.
[[nodiscard]] inline bool has_picture(const Record& record) {
  return record.technique != "speed_of_light" && record.code.empty();
}

}  // namespace triptych::record
