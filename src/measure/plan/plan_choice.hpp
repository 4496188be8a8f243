#pragma once
// The part of a plan that a user selects on the command line.

#include <string>
#include <vector>

#include "measure/plan/plan.hpp"

namespace triptych::measure {

struct PlanChoice {
  std::vector<std::string> set = {};  // each is "factor=a,b"
  std::string shard = {};             // "i/n"; empty: the whole plan
  // Each of these options reduces the configurations: to those that match one of the globs
  // (record::names_configuration), to those that the file lists, and to one n-th of the rest.
  std::vector<std::string> filter = {};
  std::string caselist = {};  // a file with a name or a key in each line
  std::string fraction = {};  // "1/n"

  // Whether the whole plan is loaded, without changes.
  [[nodiscard]] bool is_whole() const { return set.empty() && shard.empty() && !selects(); }
  // Whether configurations are selected by name or by chance, so that possibly none is left.
  [[nodiscard]] bool selects() const {
    return !filter.empty() || !caselist.empty() || !fraction.empty();
  }
  // The options that select, as typed by the user.
  [[nodiscard]] std::string selection_text() const;

  // Like load_plan(). The fraction is the same every time: the configurations are chosen by the
  // hash of their keys. At least one is chosen. All functions throw core::InputError.
  [[nodiscard]] Plan load(const std::string& plan, const FindSuite& find_suite) const;
  // "factor=a,b" → {factor, {a, b}}. A value may be plain or escaped by record::escaped.
  [[nodiscard]] Overrides overrides() const;
  [[nodiscard]] Shard part() const;
};

}  // namespace triptych::measure
