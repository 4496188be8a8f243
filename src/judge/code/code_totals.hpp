#pragma once
// Totals over many configurations, as Mesa's developers quote them in merge requests:
// "Instrs: 35678819 -> 35361617 (-0.89%); split: -0.91%, +0.02%".

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "record/code.hpp"

namespace triptych::judge {

struct CodeTotal {
  double before = 0;
  double now = 0;
  double less = 0;  // sum of what went down, as a positive number
  double more = 0;  // sum of what went up
  std::size_t helped = 0;
  std::size_t hurt = 0;
  // The configuration that got worse by the largest factor, and that factor.
  std::string worst = {};
  double worst_change = 0;
};

class CodeTotals {
 public:
  // Adds the executables and statistics that both sides have.
  void add(const std::string& configuration, const record::Code& before, const record::Code& now);

  // Keyed by the name that Mesa's developers use.
  [[nodiscard]] const std::map<std::string, CodeTotal>& totals() const { return totals_; }
  [[nodiscard]] std::size_t configurations() const { return configurations_; }
  [[nodiscard]] std::size_t changed() const { return changed_; }

  // One line per statistic that changed, each with how many configurations it helped and hurt and
  // the one that it hurt most; one line that says so where none changed.
  [[nodiscard]] std::vector<std::string> lines() const;
  // The same without the configurations, in one line.
  [[nodiscard]] std::string line() const;

 private:
  std::map<std::string, CodeTotal> totals_;
  std::size_t configurations_ = 0;
  std::size_t changed_ = 0;
};

}  // namespace triptych::judge
