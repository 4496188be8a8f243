#pragma once
// Runs a plan with one supervised worker process for each device. Records are stored as soon as
// they are made.

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "measure/plan/plan.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "measure/protocol/protocol.hpp"
#include "measure/system/interrupt.hpp"
#include "record/store.hpp"

namespace triptych::measure {

struct RunOptions {
  Protocol protocol;
  // The time limit of one configuration. A worker that exceeds it is killed and replaced.
  std::chrono::seconds limit = record::standard_limit;
  std::chrono::seconds start_limit{60};  // for opening a device and calibrating its clocks
  bool resume = false;                   // continue the plan's latest run and keep its records
  // The device and the configuration of each record that a resumed run draws again although it
  // contains it.
  std::set<std::pair<std::string, std::string>> again = {};
  std::vector<InjectedFault> faults;
  // The number of workers that run at the same time if nothing is timed; one device may have
  // several. 0: one for each device, but not more than there are processors.
  int jobs = 0;
  std::vector<std::string> worker_command;           // see SideOptions::command
  std::vector<std::string> worker_environment = {};  // see SideOptions::environment
  // The devices that the command requested, those that it found, and those that it measures.
  record::Beginning begun = {};
  // The version with its commit, which is written to the run; empty: the version only.
  std::string program = {};
};

struct Progress {
  std::string device;
  std::string configuration;
  int done = 0;
  int total = 0;
  std::chrono::seconds left{0};
  const record::Record* record = nullptr;  // the configuration that was just done
  std::optional<Loading> loading;          // otherwise, of the configuration that is being measured
};

struct RunResult {
  std::string run;  // id in the store
  // The records of the plan's run on its devices; with `resume`, including earlier ones.
  int measured = 0;
  // The number of measured records whose results were copied from an equivalent configuration
  // (measure/contract/equivalents.hpp).
  int taken_over = 0;
  int skipped = 0;
  int failed = 0;        // failed, crashed, hung or lost
  int there_before = 0;  // of all these, the number that a resumed run already contained
  double wall_ns = 0;
  // Sum of the wall-clock times of all devices; more than wall_ns if they ran in parallel.
  double devices_ns = 0;
  // The part of devices_ns outside of opening devices, preparing and drawing.
  double overhead_ns = 0;
};

// A few lines about the plan's run in the file of the store, and its result.
[[nodiscard]] std::string describe(const RunResult& result, const std::string& plan,
                                   const std::string& store);

// One of the plans that are measured together.
struct PlannedRun {
  const Plan& plan;
  const Suite& suite;
  const RunOptions& options;
};

// Measures every configuration of each plan on every device, with one device after the other, so
// that none disturbs the times of another. A crash, a hang or a lost device costs one
// configuration. If the worker of a device cannot be started twice in a row, all remaining
// configurations of the device fail with that reason. There is one result for each plan, and each
// is a run of its own. Throws InputError for an unknown fault, for environment variables that must
// not be set while measuring, for a resumed run whose device has changed, and for a resumed run
// that contains something that the changed plan does not measure; IoError if the store cannot be
// written; Interrupted.
[[nodiscard]] std::vector<RunResult> run_plans(
    std::span<const PlannedRun> runs, const std::vector<std::string>& devices, record::Store& store,
    const std::function<void(const Progress&)>& on_progress);

// Faults of these runs that apply to none of their configurations on these devices. A user who
// injects a fault and sees a pass would otherwise think that it was not found.
[[nodiscard]] std::vector<InjectedFault> faults_that_hit_nothing(
    std::span<const PlannedRun> runs, const std::vector<std::string>& devices);

// One plan that is measured on two sides. Each side is written to its own run.
struct SidesRun {
  const Plan& plan;
  const Suite& suite;
  std::array<std::string, 2> devices;
  std::array<RunOptions, 2> options;
};

// In parallel if nothing is timed, otherwise one after the other. Throws as run_plans().
[[nodiscard]] std::array<RunResult, 2> run_sides(
    const SidesRun& sides, record::Store& store,
    const std::function<void(const Progress&)>& on_progress);

// Runs a single plan.
[[nodiscard]] RunResult run_plan(const Plan& plan, const std::vector<std::string>& devices,
                                 const Suite& suite, record::Store& store,
                                 const RunOptions& options,
                                 const std::function<void(const Progress&)>& on_progress);

}  // namespace triptych::measure
