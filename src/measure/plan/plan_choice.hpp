#pragma once
// What is taken of a plan, as people write it.

#include <string>
#include <vector>

#include "measure/plan/plan.hpp"

namespace triptych::measure {

struct PlanChoice {
  std::vector<std::string> set = {};  // "factor=a,b" each
  std::string shard = {};             // "i/n"; empty: all of it

  // As load_plan(); all throw core::InputError.
  [[nodiscard]] Plan load(const std::string& plan, const FindSuite& find_suite) const;
  // "factor=a,b" → {factor, {a, b}}, each value as record::escaped spells it or plainly.
  [[nodiscard]] Overrides overrides() const;
  [[nodiscard]] Shard part() const;
};

}  // namespace triptych::measure
