#pragma once
// The differences between two runs of one plan, configuration by configuration, except timing
// differences.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "comparison/differences.hpp"
#include "judge/baselines/work.hpp"
#include "measure/truth/truths.hpp"
#include "record/store.hpp"

namespace triptych::comparison {

// A device in a run.
struct RunSide {
  const record::Store& store;
  std::string run;
  record::Device device;
};

struct ConfigurationDiff {
  std::string key;
  std::vector<Difference> differences;  // worst first
  // The reason why the times of this configuration are meaningless. If the reason is that a side
  // did not measure the configuration, `ended` is the outcome of that side.
  TimeReason no_time;
  std::optional<record::Outcome> ended;
  std::optional<judge::WorkChange> work;       // change from a to b
  std::array<bool, 2> device_clock_trusted{};  // whether the device clocks of a and b are trusted
};

struct RunDiff {
  std::vector<Difference> device;  // differences between the devices, such as in their limits
  // The configurations of run a, in the order of their records, and then the configurations that
  // only run b has.
  std::vector<ConfigurationDiff> configurations;
};

// Compares two runs. See find_differences() for `same_setup`.
[[nodiscard]] RunDiff diff_runs(const RunSide& a, const RunSide& b, measure::Truths& truths,
                                bool same_setup);

}  // namespace triptych::comparison
