#pragma once
// Parses a plan's YAML into strings with their places in the file. The strings are not interpreted,
// because the suite is not known yet. To load a plan, use plan.hpp.

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "record/check.hpp"

namespace triptych::measure {

struct PlacedText {
  std::string text;
  core::FilePlace place;
};

struct PlanEntry {
  PlacedText factor;
  std::vector<PlacedText> values;  // as written in the file; at least one
};

struct PlanText {
  PlacedText suite;
  std::string summary;
  record::Checks checks;           // empty if the plan names no checks
  std::vector<PlanEntry> entries;  // in the order of the file, without duplicate factors
  // The blocks under `also`. Each block adds combinations in which the entries of the block replace
  // the plan's own entries for the same factors.
  std::vector<std::vector<PlanEntry>> also;
};

// Parses the YAML of a plan. Error messages use `file` as the name of the file. Throws InputError
// in these cases:
// - The text is not YAML, or is not a single mapping.
// - `suite` is missing, a key is duplicated, or a list is empty.
// - A value is missing or not a scalar, or `also` is not a list of mappings.
[[nodiscard]] PlanText parse_plan(std::string_view yaml, const std::string& file);

}  // namespace triptych::measure
