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
  // A plan of the same suite that counts instructions. Empty if instructions cannot be counted on
  // one of the sides, or if the compared plan already counts them.
  std::string exact_plan = {};
  bool base = false;     // whether side a is the argument of `gate --base`
  bool verbose = false;  // whether to list all configurations
};
// Returns the command that compares the exact plan on the same sides, or "" if there is no such
// plan.
[[nodiscard]] std::string exact_command(const ComparisonCommand& command);
// Returns the command that compares only this configuration, so that the whole time budget is spent
// on its verdict.
[[nodiscard]] std::string command_for(const comparison::ComparedConfiguration& compared,
                                      const ComparisonCommand& command);

}  // namespace triptych::report
