#pragma once
// The part of a plan that a user selects on the command line.

#include <string>
#include <vector>

#include "measure/plan/plan.hpp"

namespace triptych::measure {

struct PlanChoice {
  std::vector<std::string> set = {};  // each is "factor=a,b"
  std::string shard = {};             // "i/n"; empty: the whole plan
  // Each of these options selects some of the configurations:
  // - `filter` selects those that match one of its globs (record::names_configuration()).
  // - `caselist` selects those that the file lists.
  // - `fraction` selects one n-th of the configurations that the other options leave.
  std::vector<std::string> filter = {};
  std::string caselist = {};  // a file with a configuration's name or key in each line
  std::string fraction = {};  // "1/n"

  // Returns whether the whole plan is loaded without changes.
  [[nodiscard]] bool is_whole() const { return set.empty() && shard.empty() && !selects(); }
  // Returns whether configurations are selected individually. In this case, the selection may be
  // empty.
  [[nodiscard]] bool selects() const {
    return !filter.empty() || !caselist.empty() || !fraction.empty();
  }
  // Returns the options that select configurations, as typed by the user.
  [[nodiscard]] std::string selection_text() const;

  // Loads the selected part of a plan with load_plan(). A fraction always selects the same
  // configurations, because they are chosen by the hashes of their keys. It selects at least one
  // configuration. All functions of this class throw core::InputError.
  [[nodiscard]] Plan load(const std::string& plan, const FindSuite& find_suite) const;
  // Converts each "factor=a,b" in `set` to {factor, {a, b}}. A value may be escaped by
  // record::escaped().
  [[nodiscard]] Overrides overrides() const;
  [[nodiscard]] Shard part() const;
};

}  // namespace triptych::measure
