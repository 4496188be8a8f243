#pragma once
// Compares the results of a repeated validation, and finds the cases whose results differ.

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
  std::vector<Verdict> verdicts;  // the worst of each repetition that has the case
  std::size_t images = 0;         // number of different images
  std::optional<Finding> worst;   // the finding of the first repetition with the worst verdict

  // Whether it fails in some repetitions and not in others.
  [[nodiscard]] bool flakes() const;
  [[nodiscard]] std::size_t failures() const;
};

// All cases, sorted. Findings that are not about one configuration are not compared.
[[nodiscard]] std::vector<RepeatedCase> repeated_cases(std::span<const Repetition> repetitions);

// Puts the failures of flaking cases into the results of the first repetition, as flakes.
void add_flakes(std::span<const RepeatedCase> cases, std::vector<GateResult>& first);

}  // namespace triptych::judge
