#pragma once
// Extracts findings from the JSON output of gate and validate, so that tests compare causes and
// numbers instead of sentences.

#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"

namespace triptych::command_line {

// Returns the findings with this cause, in the verdict about this plan or about all plans. `json`
// is the output of `gate --json` or the file written by `validate --json`. It may contain one
// verdict or a list of verdicts.
inline std::vector<core::Json> findings_of(const std::string& json, std::string_view cause,
                                           std::string_view plan = {}) {
  std::vector<core::Json> found;
  core::Json verdicts = core::Json::parse(json);
  if (!verdicts.is_array()) verdicts = core::Json::array({verdicts});
  for (const core::Json& verdict : verdicts) {
    if (!plan.empty() && verdict.at("plan") != plan) continue;
    for (const core::Json& finding : verdict.at("findings")) {
      if (finding.at("cause") == cause) found.push_back(finding);
    }
  }
  return found;
}

}  // namespace triptych::command_line
