#pragma once
// Findings by cause: what says the same of many configurations is told once.

#include <map>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// It points into what it was made of.
struct FindingGroup {
  const judge::Finding* first;  // the smallest case: the fewest pixels and data
  std::size_t configurations = 1;
  // The levels that tell its configurations from the others that were checked on that device,
  // "technique=raycast, step=0.5"; empty where nothing does.
  std::string signature = {};
  // Devices whose answer to the smallest case is a pass.
  std::vector<std::string> right_on = {};
  // The configuration, or "12 configurations"; empty for a finding about a whole device or plan.
  [[nodiscard]] std::string subject() const;
};

// Of the same check, verdict and device, the same message but for its numbers, and the same
// technique unless all techniques say it. Worst first: regressions, what could not be judged, the
// rest; in these what ended a program before what it drew, in the order of the checks, the most
// configurations first. Left out is a regression of correlation that one of cost explains.
[[nodiscard]] std::vector<FindingGroup> grouped(std::span<const judge::Finding> findings);

// Not a pass, not advice: somebody has to look.
[[nodiscard]] bool is_open(const judge::Finding& finding);

using Environment = std::map<std::string, std::string>;

// A command that shows the finding again, ready to be pasted; empty where none is known. `plan` as
// `triptych run` takes it, `environment`: what was set for the device.
[[nodiscard]] std::string command_of(const judge::Finding& finding, const std::string& plan,
                                     const Environment& environment = {});

}  // namespace triptych::report
