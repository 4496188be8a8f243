#pragma once
// The YAML of a plan as text with places, before anything is known of its suite. Used by plan.cpp
// alone.

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
  record::Checks checks;           // empty where it says none
  std::vector<PlanEntry> entries;  // in the order of the file, no factor twice
  // What stands under `also`: further combinations, by entries in the place of those above.
  std::vector<std::vector<PlanEntry>> also;
};

// `file` is what errors call the text. Throws InputError for what is not YAML, not one mapping, has
// no `suite`, a key twice, an empty list, a value that is not a scalar or has none, an `also`
// that is not a list of mappings.
[[nodiscard]] PlanText parse_plan(std::string_view yaml, const std::string& file);

}  // namespace triptych::measure
