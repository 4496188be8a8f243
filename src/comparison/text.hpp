#pragma once
// What a comparison found, for people and for programs.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "comparison/comparison.hpp"

namespace triptych::comparison {

// The command that was given, as far as it says what was compared: for naming one to go on with.
struct ComparisonCommand {
  std::string plan;
  std::string sides;                // "--a … --b …"
  std::vector<std::string> varied;  // factors that name a configuration of this plan
};

// A line per configuration, then what differs besides time, the worst kind first, then the verdict.
[[nodiscard]] std::string to_text(const ComparisonResult& result, const ComparisonCommand& command);

// {"plan", "sides", "a", "b" (devices), "seconds", "exit_code", "headline", "configurations":
// [{"configuration", "verdict", "reason", "ratio", "ratio_low", "ratio_high", "blocks", "launches",
// "frames_per_turn", "clock", "why_wall", "seconds", "work", "differences", "settle"}]}; what is
// not known is left out.
[[nodiscard]] nlohmann::json to_json(const ComparisonResult& result,
                                     const ComparisonCommand& command);

}  // namespace triptych::comparison
