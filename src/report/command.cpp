#include "report/command.hpp"

#include <fmt/format.h>

#include "core/quoting.hpp"
#include "record/factor_list.hpp"
#include "record/reason.hpp"

namespace triptych::report {

std::string text_of(const Command& command) {
  std::vector<std::string> words{"triptych", command.command, command.object};
  if (!command.device.empty()) words.insert(words.end(), {"--device", command.device});
  for (const auto& [factor, level] : command.factors) {
    words.insert(words.end(), {"--set", record::factor_list({{factor, level}})});
  }
  for (const std::string& fault : command.injected) words.insert(words.end(), {"--inject", fault});
  if (command.limit && *command.limit != record::standard_limit) {
    words.insert(words.end(), {"--limit", fmt::format("{}", command.limit->count())});
  }
  words.insert(words.end(), command.more.begin(), command.more.end());
  std::string text;
  for (const auto& [name, value] : command.environment) {
    text += name + "=" + core::shell_quoted(value) + " ";
  }
  return text + core::shell_command(words);
}

}  // namespace triptych::report
