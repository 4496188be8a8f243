#pragma once
// Totals of code statistics over many configurations, under the names that Mesa developers use in
// merge requests.

#include <cstddef>
#include <map>
#include <string>

#include "record/code.hpp"

namespace triptych::judge {

struct CodeTotal {
  double before = 0;
  double now = 0;
  double less = 0;  // sum of all decreases, as a positive number
  double more = 0;  // sum of all increases
  std::size_t helped = 0;
  std::size_t hurt = 0;
  // The configuration that got worse by the largest factor, its values before and now, and that
  // factor.
  std::string worst = {};
  double worst_before = 0;
  double worst_now = 0;
  double worst_change = 0;
  bool operator==(const CodeTotal&) const = default;
};

class CodeTotals {
 public:
  // Adds the statistics of one configuration. Executables and statistics that only `before` or
  // only `now` contains are left out.
  void add(const std::string& configuration, const record::Code& before, const record::Code& now);

  // Returns the totals. The keys are the names that Mesa developers use.
  [[nodiscard]] const std::map<std::string, CodeTotal>& totals() const { return totals_; }
  [[nodiscard]] std::size_t configurations() const { return configurations_; }
  [[nodiscard]] std::size_t changed() const { return changed_; }

 private:
  std::map<std::string, CodeTotal> totals_;
  std::size_t configurations_ = 0;
  std::size_t changed_ = 0;
};

}  // namespace triptych::judge
