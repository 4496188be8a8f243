#pragma once
// The command that continues a comparison.

#include <string>
#include <vector>

#include "comparison/comparison.hpp"

namespace triptych::report {

// The parts of the command that determine what was compared, from which commands for a continuation
// are made.
struct ComparisonCommand {
  std::string plan;
  std::string sides;                // "--a … --b …"
  std::vector<std::string> varied;  // factors that identify a configuration of this plan
};
// The command that measures this configuration alone, as long as necessary.
[[nodiscard]] std::string command_for(const comparison::Compared& compared,
                                      const ComparisonCommand& command);

}  // namespace triptych::report
