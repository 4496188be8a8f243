#pragma once
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Findings that say the same of several configurations on one device. It points into what it was
// made of.
struct FindingGroup {
  const judge::Finding* first;
  std::size_t configurations = 1;
  // The configuration, or "12 configurations"; empty for a finding about a whole device or plan.
  [[nodiscard]] std::string subject() const;
};

// In the order of their first. Regressions and what could not be judged stand alone: each has to be
// looked at.
[[nodiscard]] std::vector<FindingGroup> grouped(std::span<const judge::Finding> findings);

}  // namespace triptych::report
