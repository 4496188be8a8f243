#pragma once
// What two counts of one frame differ by, and whether they may.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "judge/finding.hpp"
#include "record/record.hpp"

namespace triptych::judge {

// The parts of Record::cost that decide.
inline constexpr std::array<std::string_view, 2> cost_parts{"device_code", "driver"};

[[nodiscard]] std::optional<double> count_of(const record::Counts& counts, std::string_view name);
// Instructions of the parts that decide.
[[nodiscard]] double frame_of(const record::Counts& cost);

struct FrameChange {
  bool more = false;            // some part is more than it may be
  bool less = false;            // likewise
  std::vector<Change> changes;  // of each part that is, and of allocations beside them
};

// By cost_tolerance.hpp, which holds for one driver, one program and one counter.
[[nodiscard]] FrameChange frame_change(const record::Record& now, const record::Counts& before);

}  // namespace triptych::judge
