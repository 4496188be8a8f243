#pragma once
#include <string>

#include "record/record.hpp"

namespace triptych::judge {

// By how many fragments a counter of a frame may differ between two right drivers, in addition to
// comparisons of floats with thresholds. 0 for counters that do not depend on rasterization.
[[nodiscard]] double open_fragments(const std::string& counter, const record::Record& record);

}  // namespace triptych::judge
