#pragma once
// The result of a comparison, for people and for programs.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "comparison/comparison.hpp"

namespace triptych::comparison {

// The parts of the command that determine what was compared, from which commands for a continuation
// are made.
struct ComparisonCommand {
  std::string plan;
  std::string sides;                // "--a … --b …"
  std::vector<std::string> varied;  // factors that identify a configuration of this plan
};

// The differences except times with the worst kind first, then one line for each configuration that
// was timed, then the verdict.
[[nodiscard]] std::string to_text(const ComparisonResult& result, const ComparisonCommand& command);

// "FAIL: 18 slower, 2 regressions in what repeats, 0 fixed, 1 changed; 64 s"
[[nodiscard]] std::string headline(const ComparisonResult& result);

// [{"kind", "about", "text", "ratio"}]
[[nodiscard]] nlohmann::json to_json(const std::vector<Difference>& differences);

// {"plan", "sides", "a", "b" (devices), "seconds", "exit_code", "headline", "differences" (of the
// devices), "configurations": [{"configuration", "reason", "differences": [{"kind", "about",
// "text", "ratio"}], "work"; for times "verdict", "ratio", "ratio_low", "ratio_high", "blocks",
// "process_runs", "frames_per_batch", "clock", "why_wall", "seconds", "settle"}]}. Unknown values
// are left out.
[[nodiscard]] nlohmann::json to_json(const ComparisonResult& result,
                                     const ComparisonCommand& command);

}  // namespace triptych::comparison
