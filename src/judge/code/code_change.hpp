#pragma once
// Compares the statistics and the disassembly that GPU compilers report for two builds of the same
// device code.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "record/code.hpp"

namespace triptych::judge {

// The meaning of a statistic that a driver reports. Drivers use different names for the same
// quantity. Changes of a statistic with an unknown name are shown but do not affect the verdict.
struct CodeStatistic {
  std::string_view name;  // such as "occupancy"; empty for an unknown statistic
  // The name in Mesa's shader-db totals, such as "MaxWaves", or empty.
  std::string_view mesa_name = {};
  bool decides = false;       // whether a change for the worse is a regression
  bool more_is_worse = true;  // used only for totals and if `decides` is true
  int rank = 100;             // statistics are printed in this order, the most important first

  [[nodiscard]] bool is_occupancy() const { return rank == 0; }
  // Returns whether a relative change of the statistic is meaningful. This is the case if the
  // statistic affects the verdict, unless it is an amount of spills or scratch memory, which is
  // ideally 0.
  [[nodiscard]] bool has_relative_change() const { return decides && rank >= 4; }
  [[nodiscard]] bool counts_registers() const { return rank == 10 || rank == 11; }
};
[[nodiscard]] CodeStatistic code_statistic(std::string_view driver_name);

struct CodeChange {
  std::string executable;
  std::string driver_name;
  CodeStatistic statistic;
  double before = 0;
  double now = 0;
  [[nodiscard]] bool worse() const {
    return statistic.decides && (now > before) == statistic.more_is_worse;
  }
  [[nodiscard]] bool better() const { return statistic.decides && !worse(); }
};

enum class CodeDirection { same, other, worse, better };

struct CodeComparison {
  std::vector<CodeChange> changes;       // the most important statistics first
  std::vector<std::string> removed;      // executables that no longer exist
  std::vector<std::string> added;        // executables that did not exist before
  std::vector<std::string> reassembled;  // executables whose disassembly changed
  // Returns whether the code got better or worse, according to all changed statistics that affect
  // the verdict. If some of them improved and others got worse, the inverse throughput decides. If
  // the inverse throughput did not change or is not reported, returns `worse`, so that a person has
  // to accept the mixed change. Returns `other` if no changed statistic affects the verdict.
  [[nodiscard]] CodeDirection direction() const;
  [[nodiscard]] bool mixed() const;
};

[[nodiscard]] CodeComparison compare_code(const record::Code& before, const record::Code& now);

}  // namespace triptych::judge
