#pragma once
// The command that continues a comparison.

#include <string>
#include <vector>

#include "comparison/comparison.hpp"

namespace triptych::report {

// The parts of the command line that determine what was compared. Commands that continue the
// comparison are made from them.
struct ComparisonCommand {
  std::string plan;
  std::string sides;                // "--a … --b …"
  std::vector<std::string> varied;  // factors that identify a configuration of this plan
};
// The command that measures only this configuration, and as long as a verdict needs.
[[nodiscard]] std::string command_for(const comparison::Compared& compared,
                                      const ComparisonCommand& command);

}  // namespace triptych::report
