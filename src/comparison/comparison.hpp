#pragma once
// Compares two sides (a and b), such as two devices, drivers or builds, over all configurations of
// a plan. First compares the deterministic measurements (images, counters, statistics, cost,
// memory), and then interleaved frame times.

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "comparison/pairwise.hpp"
#include "comparison/run_diff.hpp"
#include "measure/plan/plan.hpp"
#include "measure/run/interleaved.hpp"
#include "measure/run/runner.hpp"

namespace triptych::comparison {

struct ComparisonOptions {
  measure::Plan plan;
  measure::SideOptions a;
  measure::SideOptions b;
  std::vector<measure::InjectedFault> faults;  // faults to inject into side b
  // The time budget, counted from the start of the comparison. When it is used up, no further
  // blocks (groups of interleaved batches of frames) are measured. Three measurements take place
  // regardless of the budget, because there would be no result without them:
  //   - the deterministic measurements,
  //   - the first blocks of each configuration, up to the first evaluation of its times,
  //   - min_process_runs fresh process runs, which confirm that a configuration is slower or
  //     faster. Part of the budget is reserved for these process runs.
  std::optional<std::chrono::seconds> budget;
  std::chrono::seconds limit{60};
  std::uint64_t seed = 1;
  bool times = true;  // whether to measure times if the plan includes them
  SequentialDesign design = SequentialDesign::standard();
  ConfirmationDesign confirmation;
};

// The frame times of one side: the median and the quartiles over the blocks from which the shift
// was estimated. These are the blocks of all fresh process runs (lifetimes of worker processes) if
// the configuration was measured again to confirm its result, and otherwise those of the first
// process run.
using SideTime = record::Summary;

// The results of comparing one configuration.
struct ComparedConfiguration {
  std::string key;
  measure::Configuration configuration;
  // The outcome of the side that did not finish. `skipped` means that this side does not support
  // the configuration.
  std::optional<record::Outcome> ended;
  PairVerdict verdict = PairVerdict::undecided;
  TimeReason reason;     // why there is no verdict, or why the confirmation withdrew it
  Shift shift;           // change in ln(frame time) from a to b; invalid if a side did not finish
  int blocks = 0;        // number of blocks measured in the first process run
  int process_runs = 0;  // number of fresh process runs measured for the confirmation
  int frames_per_batch = 1;
  measure::SideClock clock = measure::SideClock::wall;
  WallClockCause wall_clock_cause = WallClockCause::none;
  bool out_of_budget = false;  // whether measuring ended because the time budget was used up
  double seconds = 0;          // time spent on this configuration
  std::optional<std::array<SideTime, 2>> times = {};  // frame times of a and b, in ns
  std::optional<judge::WorkChange> work;
  std::vector<Difference> differences;

  [[nodiscard]] bool is_regression() const;
  [[nodiscard]] bool is_inconclusive(bool timed) const;
  // Returns the verdict on the time of this configuration: "slower", …, "skipped" or "undecided".
  [[nodiscard]] std::string_view verdict_name() const;
  // Returns whether `shift` was measured.
  [[nodiscard]] bool has_time() const { return blocks > 0 && !ended; }
};

// The time ratios of all configurations together.
struct OverallTime {
  int decided = 0;    // number of configurations with a verdict other than `undecided`
  int undecided = 0;  // number of configurations that were timed without a verdict
  int averaged = 0;   // number of configurations whose confidence interval is finite
  // The mean of the shifts of the averaged configurations. Each end of the interval is the mean of
  // the corresponding ends of their intervals. The standard error of a mean is at most the mean of
  // the standard errors, so the interval is wide enough even if the errors of all configurations
  // are correlated, for example because the machine was busy.
  Shift shift;
};

struct ComparisonResult {
  record::Device a;
  record::Device b;
  bool timed = false;
  std::vector<Difference> device = {};  // differences between the devices, such as in their limits
  std::vector<ComparedConfiguration> configurations = {};  // in the plan's order
  double seconds = 0;
  // The environment variables ("NAME=VALUE") that were set for each side.
  std::array<std::vector<std::string>, 2> environment = {};
  std::array<std::string, 2> programs = {};  // set if the sides run different builds of Triptych
  std::array<std::vector<record::ClockTrust>, 2> clocks = {};
  // The variables that select a driver and differ between the sides, if both sides have loaded the
  // same version of the same driver nevertheless. The driver was then compared with itself, unless
  // two builds of one version exist.
  std::vector<std::string> ineffective_variables = {};
  // The mean number of threads of other programs that were ready to run per CPU core, sampled after
  // each block of interleaved times. At these moments, both workers wait for a request.
  std::optional<double> other_load = {};

  [[nodiscard]] core::ExitCode exit_code() const;
  // Groups all differences except timing differences.
  [[nodiscard]] std::vector<DifferenceGroup> groups() const;
  // Returns nullopt unless times with finite intervals were measured for two or more
  // configurations.
  [[nodiscard]] std::optional<OverallTime> overall_time() const;
};

enum class ComparisonStage : std::uint8_t {
  deterministic,  // images, counters, statistics, cost and memory
  first_look,
  more_blocks,
  fresh_process_runs
};

struct ComparisonProgress {
  ComparisonStage stage = ComparisonStage::deterministic;
  std::size_t process_run = 0;   // number of the current fresh process run
  std::size_t process_runs = 0;  // total number of fresh process runs
  std::string configuration;
  int done = 0;
  int total = 0;
  std::chrono::seconds left{0};  // upper limit for the remaining time
  std::optional<measure::Loading> loading;
};

using OnProgress = std::function<void(const ComparisonProgress&)>;

// Compares the sides, and writes the runs of both sides to the store. Throws the same exceptions as
// measure::run_sides() and measure::Interleaved. Throws record::NotMeasured if the device of a side
// cannot be opened.
[[nodiscard]] ComparisonResult compare(const ComparisonOptions& options,
                                       const measure::Suite& suite, record::Store& store,
                                       measure::Truths& truths, const OnProgress& on_progress);

}  // namespace triptych::comparison
