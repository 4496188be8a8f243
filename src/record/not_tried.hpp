#pragma once
// What ended the worker twice is not tried on every configuration that it would meet: those have
// the outcome and the reason of those that were, and this behind it.

#include <string_view>

#include "record/record.hpp"

namespace triptych::record {

// Then " with " and the levels that they share, where they share any.
inline constexpr std::string_view not_tried = "; not tried, as others ended so";

[[nodiscard]] inline bool was_not_tried(const Record& record) {
  return record.reason.find(not_tried) != std::string::npos;
}

}  // namespace triptych::record
