#pragma once
// The differences between two runs of one plan, configuration by configuration, except in time.

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
  // The reason why its times are meaningless, and the outcome of the side that is to blame, if
  // there is one.
  std::string void_time;
  std::optional<record::Outcome> ended;
  std::optional<judge::WorkChange> work;       // b relative to a
  std::array<bool, 2> device_clock_trusted{};  // of a and of b
};

struct RunDiff {
  std::vector<Difference> device;                 // between the two devices themselves
  std::vector<ConfigurationDiff> configurations;  // in a's order, followed by those that only b has
};

// `same_setup`: see find_differences.
[[nodiscard]] RunDiff diff_runs(const RunSide& a, const RunSide& b, measure::Truths& truths,
                                bool same_setup);

// The line for a comparison without differences because nothing was measured. `reason` is that of
// the first configuration.
[[nodiscard]] std::string nothing_compared(const std::string& reason);

// Differences of one kind about one thing, which are reported once.
struct DifferenceGroup {
  std::string text;   // of the one that changed most, otherwise of the first
  std::string where;  // its configuration; empty: the device
  int count = 0;
  std::optional<std::pair<double, double>> ratios;  // smallest and largest
};

class DifferenceGroups {
 public:
  // `where` is the configuration; empty: the device.
  void add(const std::vector<Difference>& differences, const std::string& where);
  [[nodiscard]] bool empty() const noexcept { return groups_.empty(); }
  // "regression  cost: +1.2 % to +40 % in 27 configurations, most in …: …": one line each, sorted
  // by kind with the worst first, then by subject.
  [[nodiscard]] std::string text() const;

 private:
  void add(const Difference& difference, const std::string& where);

  // By kind, subject and injected faults.
  std::map<std::tuple<DifferenceKind, std::string, std::string>, DifferenceGroup> groups_;
};

}  // namespace triptych::comparison
