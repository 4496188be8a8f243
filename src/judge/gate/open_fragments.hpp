#pragma once
#include <string>

#include "record/record.hpp"

namespace triptych::judge {

// The number of fragments by which a counter of a frame may differ between two correct drivers, in
// addition to comparisons of floats with thresholds. 0 for counters that do not depend on
// rasterization.
[[nodiscard]] double open_fragments(const std::string& counter, const record::Record& record);

}  // namespace triptych::judge
