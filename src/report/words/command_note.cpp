// The sentence about environment variables that a printed command leaves out.

#include "report/words/command_note.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "report/command.hpp"
#include "report/finding_command.hpp"

namespace triptych::report::words {

std::string command_note(const judge::Finding& finding, const judge::GateResult& result) {
  const auto set = result.environments.find(finding.device);
  if (set == result.environments.end() || command_of(finding, result).empty()) return {};
  const std::vector<std::string> names = omitted_variables(set->second);
  if (names.empty()) return {};
  const bool one = names.size() == 1;
  std::string text = fmt::format(
      "{} {} set during the measurement, but the command does not set {}, because {} could load "
      "other code",
      fmt::join(names, ", "), one ? "was" : "were", one ? "it" : "them", one ? "it" : "they");
  if (const auto device = result.tested.find(finding.device); device != result.tested.end()) {
    text += fmt::format("; if the command does not use driver version {}, set {} before it",
                        device->second.driver_version, one ? "it" : "them");
  }
  return text;
}

}  // namespace triptych::report::words
