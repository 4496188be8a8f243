#include "report/comparison_command.hpp"

#include <fmt/format.h>

#include "core/quoting.hpp"
#include "record/factor_list.hpp"

namespace triptych::report {

std::string command_for(const comparison::ComparedConfiguration& compared,
                        const ComparisonCommand& command) {
  std::string text =
      fmt::format("triptych compare {} {}", core::shell_quoted(command.plan), command.sides);
  for (const std::string& factor : command.varied) {
    const std::string level = record::factor_list({{factor, compared.configuration.at(factor)}});
    text += " --set " + core::shell_quoted(level);
  }
  return text;
}

std::string exact_command(const ComparisonCommand& command) {
  if (command.exact_plan.empty()) return {};
  return fmt::format("triptych compare {} {}", core::shell_quoted(command.exact_plan),
                     command.sides);
}

}  // namespace triptych::report
