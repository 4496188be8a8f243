#pragma once
// The differences between two runs of one plan, configuration by configuration, except in time.

#include <array>
#include <optional>
#include <string>
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
  // The reason why its times are meaningless, and the outcome of the side that did not measure it,
  // if that is the reason.
  TimeReason no_time;
  std::optional<record::Outcome> ended;
  std::optional<judge::WorkChange> work;       // b relative to a
  std::array<bool, 2> device_clock_trusted{};  // of a and of b
};

struct RunDiff {
  std::vector<Difference> device;  // between the two devices themselves
  // In the order of a, followed by those that only b has.
  std::vector<ConfigurationDiff> configurations;
};

// `same_setup`: see find_differences.
[[nodiscard]] RunDiff diff_runs(const RunSide& a, const RunSide& b, measure::Truths& truths,
                                bool same_setup);

}  // namespace triptych::comparison
