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

// What differs besides time, the worst kind first, then a line per configuration that was timed,
// then the verdict.
[[nodiscard]] std::string to_text(const ComparisonResult& result, const ComparisonCommand& command);

// "FAIL: 18 slower, 2 regressions in what repeats, 0 fixed, 1 changed; 64 s"
[[nodiscard]] std::string headline(const ComparisonResult& result);

// [{"kind", "about", "text", "ratio"}]
[[nodiscard]] nlohmann::json to_json(const std::vector<Difference>& differences);

// {"plan", "sides", "a", "b" (devices), "seconds", "exit_code", "headline", "differences" (of the
// devices), "configurations": [{"configuration", "reason", "differences": [{"kind", "about",
// "text", "ratio"}], "work"; of times "verdict", "ratio", "ratio_low", "ratio_high", "blocks",
// "process_runs", "frames_per_batch", "clock", "why_wall", "seconds", "settle"}]}; what is not
// known is left out.
[[nodiscard]] nlohmann::json to_json(const ComparisonResult& result,
                                     const ComparisonCommand& command);

}  // namespace triptych::comparison
