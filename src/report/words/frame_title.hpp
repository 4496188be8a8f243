#pragma once
#include <string>

#include "judge/finding.hpp"

namespace triptych::report::words {

// Returns a title that states how the frame fails, such as "A frame that crashes on gl:x". Contains
// no text from drivers.
[[nodiscard]] std::string frame_title(const judge::Observation& failure, const std::string& device);

}  // namespace triptych::report::words
