#pragma once
// Parses a plan's YAML to strings with their places in the file. They are not interpreted, because
// the suite is not known yet. Only plan.cpp uses this file.

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
  std::vector<PlacedText> values;  // as written; at least one
};

struct PlanText {
  PlacedText suite;
  std::string summary;
  record::Checks checks;           // empty if the plan does not state any
  std::vector<PlanEntry> entries;  // in the order of the file, without duplicate factors
  // The blocks under `also`. Each of them adds combinations, in which its entries replace the
  // entries above.
  std::vector<std::vector<PlanEntry>> also;
};

// Parses the YAML of a plan. Error messages use `file` as its name. Throws InputError if the text
// is not YAML or not one mapping, or for a missing `suite`, a duplicate key, an empty list, a value
// that is missing or not a scalar, or an `also` that is not a list of mappings.
[[nodiscard]] PlanText parse_plan(std::string_view yaml, const std::string& file);

}  // namespace triptych::measure
