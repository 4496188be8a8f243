#include "report/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "core/quoting.hpp"
#include "record/factor_list.hpp"
#include "record/reason.hpp"

namespace triptych::report {
namespace {

constexpr std::array<std::string_view, 8> driver_settings{
    "GALLIUM_", "GALLIVM_", "LIBGL_ALWAYS_", "LP_", "MESA_", "POCL_", "RUSTICL_", "TRIPTYCH_"};

// Parts of the names of settings that name a file or folder, which the driver may overwrite.
constexpr std::array<std::string_view, 5> file_settings{"_DIR", "_DUMP", "_FILE", "_PATH",
                                                        "_TRACE"};

bool is_harmless_setting(const std::string& name, const std::string& value) {
  const bool setting = std::ranges::any_of(
      driver_settings, [&](std::string_view prefix) { return name.starts_with(prefix); });
  const bool file = std::ranges::any_of(
      file_settings, [&](std::string_view part) { return name.find(part) != std::string::npos; });
  return setting && !file && core::is_shell_name(name) &&
         value.find_first_of("/=") == std::string::npos;
}

bool is_set_in_process(const std::string& name, const std::string& value) {
  const char* own_value = std::getenv(name.c_str());
  return own_value != nullptr && value == own_value;
}

}  // namespace

std::map<std::string, std::string> allowed_environment(
    std::map<std::string, std::string> environment) {
  std::erase_if(environment, [](const auto& variable) {
    const auto& [name, value] = variable;
    return !is_harmless_setting(name, value) && !is_set_in_process(name, value);
  });
  return environment;
}

std::vector<std::string> omitted_variables(const std::map<std::string, std::string>& environment) {
  const std::map<std::string, std::string> allowed = allowed_environment(environment);
  std::vector<std::string> names;
  for (const auto& [name, value] : environment) {
    if (!allowed.contains(name)) names.push_back(name);
  }
  return names;
}

std::string text_of(const Command& command) {
  std::vector<std::string> words{"triptych", command.command, command.object};
  if (!command.device.empty()) words.insert(words.end(), {"--device", command.device});
  for (const auto& [factor, level] : command.factors) {
    words.insert(words.end(), {"--set", record::factor_list({{factor, level}})});
  }
  for (const std::string& fault : command.injected) words.insert(words.end(), {"--inject", fault});
  if (command.limit && *command.limit != record::default_limit) {
    words.insert(words.end(), {"--limit", fmt::format("{}", command.limit->count())});
  }
  words.insert(words.end(), command.more.begin(), command.more.end());
  return core::shell_environment(command.environment) + core::shell_command(words);
}

}  // namespace triptych::report
