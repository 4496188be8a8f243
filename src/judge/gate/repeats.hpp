#pragma once
// Finds the cases whose results differ between repetitions of a validation.

#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::judge {

// A case is one configuration of a plan on one device.
struct CaseKey {
  std::string plan;
  std::string device;
  std::string configuration;
  auto operator<=>(const CaseKey&) const = default;
};

// One repetition: the results of all plans, and the hash of each case's image.
struct Repetition {
  std::vector<GateResult> results;
  std::map<CaseKey, std::string> images;
};

struct RepeatedCase {
  CaseKey key;
  std::vector<Verdict> verdicts;  // the worst verdict in each repetition that has the case
  std::size_t images = 0;         // number of different images
  std::optional<Finding> worst;   // the finding of the first repetition with the worst verdict

  // Returns whether the case fails in some repetitions and not in others.
  [[nodiscard]] bool is_flaky() const;
  [[nodiscard]] std::size_t failures() const;
};

// Returns all cases, sorted by key. Findings that are not about one configuration are ignored.
[[nodiscard]] std::vector<RepeatedCase> repeated_cases(std::span<const Repetition> repetitions);

// Adds a finding for each flaky case to the results of the first repetition, marked as a flake.
void add_flakes(std::span<const RepeatedCase> cases, std::vector<GateResult>& first);

}  // namespace triptych::judge
