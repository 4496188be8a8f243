#pragma once
// The part of a plan that a user selects on the command line.

#include <string>
#include <vector>

#include "measure/plan/plan.hpp"

namespace triptych::measure {

struct PlanChoice {
  std::vector<std::string> set = {};  // each is "factor=a,b"
  std::string shard = {};             // "i/n"; empty: the whole plan

  // Like load_plan(). All functions throw core::InputError.
  [[nodiscard]] Plan load(const std::string& plan, const FindSuite& find_suite) const;
  // "factor=a,b" → {factor, {a, b}}. Each value may be written plainly or as record::escaped writes
  // it.
  [[nodiscard]] Overrides overrides() const;
  [[nodiscard]] Shard part() const;
};

}  // namespace triptych::measure
