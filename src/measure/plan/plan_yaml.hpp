#pragma once
// The content of a plan's YAML as texts with their places in the file, before its suite is known.
// Only plan.cpp uses it.

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
  std::vector<PlanEntry> entries;  // in the order of the file, no factor twice
  // The entries under `also`: further combinations, in which they replace the entries above.
  std::vector<std::vector<PlanEntry>> also;
};

// `file` is the name of the text in errors. Throws InputError if the text is not YAML or not one
// mapping, or for a missing `suite`, a duplicate key, an empty list, a value that is missing or not
// a scalar, or an `also` that is not a list of mappings.
[[nodiscard]] PlanText parse_plan(std::string_view yaml, const std::string& file);

}  // namespace triptych::measure
