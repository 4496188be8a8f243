#pragma once
// Creates a command that repeats the comparison of one configuration.

#include <string>
#include <vector>

#include "comparison/comparison.hpp"

namespace triptych::report {

// The parts of the command line that determine what was compared.
struct ComparisonCommand {
  std::string plan;
  std::string sides;                // "--a … --b …"
  std::vector<std::string> varied;  // the factors that distinguish the plan's configurations
};
// Returns the command that compares only this configuration, so that the whole time budget is spent
// on its verdict.
[[nodiscard]] std::string command_for(const comparison::ComparedConfiguration& compared,
                                      const ComparisonCommand& command);

}  // namespace triptych::report
