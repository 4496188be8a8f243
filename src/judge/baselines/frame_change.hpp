#pragma once
// What two counts of one frame differ by, and whether they may.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "record/record.hpp"

namespace triptych::judge {

// The parts of Record::cost that decide, and what people call them.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 2> cost_parts{
    {{"device_code", "generated code"}, {"driver", "driver"}}};

[[nodiscard]] std::optional<double> count_of(const record::Counts& counts, std::string_view name);
// Instructions of the parts that decide.
[[nodiscard]] double frame_of(const record::Counts& cost);

// "generated code 1000 → 1001 (+0.1 %)"
[[nodiscard]] std::string change_text(std::string_view name, double before, double now);

struct FrameChange {
  bool more = false;               // some part is more than it may be
  bool less = false;               // likewise
  std::vector<std::string> texts;  // of each part that is
};

// By cost_tolerance.hpp, which holds for one driver, one program and one counter.
[[nodiscard]] FrameChange frame_change(const record::Record& now, const record::Counts& before);

}  // namespace triptych::judge
