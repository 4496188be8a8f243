#pragma once
#include <string>

#include "record/record.hpp"

namespace triptych::judge {

// Returns the number of fragments by which a counter of a frame may differ between two correct
// drivers because of rasterization. Returns 0 for counters that do not depend on rasterization.
[[nodiscard]] double open_fragments(const std::string& counter, const record::Record& record);

}  // namespace triptych::judge
