#pragma once
#include <string>

#include "record/record.hpp"

namespace triptych::judge {

// By how many fragments a counter of a frame may differ between two drivers that are both right,
// beside what a threshold on floats decides; 0 for counters that rasterization does not touch.
[[nodiscard]] double open_fragments(const std::string& counter, const record::Record& record);

}  // namespace triptych::judge
