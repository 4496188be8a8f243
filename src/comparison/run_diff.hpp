#pragma once
// Two runs of one plan, configuration by configuration: what differs besides time.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "comparison/differences.hpp"
#include "judge/baselines/work.hpp"
#include "measure/truth/truths.hpp"
#include "record/store.hpp"

namespace triptych::comparison {

// One device of one run.
struct RunSide {
  const record::Store& store;
  std::string run;
  record::Device device;
};

struct ConfigurationDiff {
  std::string key;
  std::vector<Difference> differences;  // worst first
  // Why no time of it means anything, and how the side ended that is to blame, if it did.
  std::string void_time;
  std::optional<record::Outcome> ended;
  std::optional<judge::WorkChange> work;       // b against a
  std::array<bool, 2> device_clock_trusted{};  // of a and of b
};

struct RunDiff {
  std::vector<Difference> device;                 // of the two as such
  std::vector<ConfigurationDiff> configurations;  // in a's order, then what only b has
};

// `same_setup`: as find_differences.
[[nodiscard]] RunDiff diff_runs(const RunSide& a, const RunSide& b, measure::Truths& truths,
                                bool same_setup);

// A line for where nothing differs because nothing was measured; `reason`: of the first
// configuration.
[[nodiscard]] std::string nothing_compared(const std::string& reason);

// Differences of one kind about one thing, told once.
struct DifferenceGroup {
  std::string text;   // of the one that changed most, else of the first
  std::string where;  // its configuration; empty: the device
  int count = 0;
  std::optional<std::pair<double, double>> ratios;  // least and largest
};

class DifferenceGroups {
 public:
  // `where`: the configuration; empty: the device.
  void add(const std::vector<Difference>& differences, const std::string& where);
  [[nodiscard]] bool empty() const noexcept { return groups_.empty(); }
  // "regression  cost: +1.2 % to +40 % in 27 configurations, most in …: …", a line each, by kind,
  // worst first, then by what they are about.
  [[nodiscard]] std::string text() const;

 private:
  void add(const Difference& difference, const std::string& where);

  // By kind, what they are about and what was injected.
  std::map<std::tuple<DifferenceKind, std::string, std::string>, DifferenceGroup> groups_;
};

}  // namespace triptych::comparison
