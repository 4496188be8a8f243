#include "app/validate_arguments.hpp"

#include <fmt/format.h>

#include "core/quoting.hpp"

namespace triptych::app {

std::string resume_command(const ValidateArguments& arguments) {
  std::vector<std::string> words{"triptych", "validate"};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  for (const std::string& device : arguments.devices) add("--device", device);
  words.emplace_back("--resume");
  add("--out", arguments.out);
  add("--shard", arguments.choice.shard);
  for (const std::string& glob : arguments.choice.filter) add("--filter", glob);
  add("--caselist", arguments.choice.caselist);
  add("--fraction", arguments.choice.fraction);
  if (arguments.jobs > 0) add("--jobs", fmt::to_string(arguments.jobs));
  if (arguments.limit_s != default_limit_s) add("--limit", fmt::to_string(arguments.limit_s));
  add("--expect", arguments.expect);
  if (arguments.baselines != default_baselines().string()) add("--baselines", arguments.baselines);
  if (arguments.without_data) words.emplace_back("--without-data");
  return core::shell_command(words);
}

}  // namespace triptych::app
