#pragma once
// Runs a plan with one supervised worker process for each device. Records are stored as soon as
// they exist.

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
  std::chrono::seconds start_limit{60};  // time limit for opening a device and calibrating
  bool resume = false;                   // continue the plan's latest run and keep its records
  // The device and the configuration of each record that a resumed run contains but measures again.
  std::set<std::pair<std::string, std::string>> again = {};
  std::vector<InjectedFault> faults;
  // The number of workers that run at the same time if nothing is timed; one device may have
  // several. 0: one for each device, but not more than there are processors.
  int jobs = 0;
  std::vector<std::string> worker_command;           // see SideOptions::command
  std::vector<std::string> worker_environment = {};  // see SideOptions::environment
  // The devices that the command requested, those that it found, and those that it measures.
  record::Beginning begun = {};
  // The version of the program with its commit, which is stored in the run. If empty, only the
  // version is stored.
  std::string program = {};
};

struct Progress {
  std::string device;
  std::string configuration;
  int done = 0;
  int total = 0;
  std::chrono::seconds left{0};
  const record::Record* record = nullptr;  // the record that was just completed
  std::optional<Loading> loading;  // if `record` is null: loading for the current configuration
};

struct RunResult {
  std::string run;  // id of the run in the store
  // The number of records of each outcome, on all devices; with `resume`, including earlier
  // records.
  int measured = 0;
  // The number of measured records whose results were copied from an equivalent configuration
  // (measure/contract/equivalents.hpp).
  int taken_over = 0;
  int skipped = 0;
  int failed = 0;        // failed, crashed, hung or lost
  int there_before = 0;  // number of these records that a resumed run already contained
  double wall_ns = 0;
  // Sum of the wall-clock times of all devices; more than wall_ns if they ran in parallel.
  double devices_ns = 0;
  // The part of devices_ns that was not spent on opening devices, preparing and drawing.
  double overhead_ns = 0;
};

// Returns a few lines about the result of the plan's run. `store` is the file of the store.
[[nodiscard]] std::string describe(const RunResult& result, const std::string& plan,
                                   const std::string& store);

// One of the plans that are measured together.
struct PlannedRun {
  const Plan& plan;
  const Suite& suite;
  const RunOptions& options;
};

// Measures every configuration of each plan on every device. If times are measured, the devices are
// measured one after the other, so that they do not disturb each other. A crash, a hang or a lost
// device affects only one configuration. If the worker of a device cannot be started twice in a
// row, all remaining configurations of the device fail with that reason. Each plan has its own run
// and its own result. Throws InputError for an unknown fault, for environment variables that must
// not be set while measuring, for a resumed run whose device has changed, and for a resumed run
// that contains something that the changed plan does not measure; IoError if the store cannot be
// written; Interrupted.
[[nodiscard]] std::vector<RunResult> run_plans(
    std::span<const PlannedRun> runs, const std::vector<std::string>& devices, record::Store& store,
    const std::function<void(const Progress&)>& on_progress);

// Returns the injected faults that apply to none of the configurations on these devices. If they
// were not reported, a user who injects a fault and sees a pass would think that the fault was not
// detected.
[[nodiscard]] std::vector<InjectedFault> faults_that_hit_nothing(
    std::span<const PlannedRun> runs, const std::vector<std::string>& devices);

// One plan that is measured on two sides. Each side is written to its own run.
struct SidesRun {
  const Plan& plan;
  const Suite& suite;
  std::array<std::string, 2> devices;
  std::array<RunOptions, 2> options;
};

// Measures both sides, in parallel if nothing is timed, otherwise one after the other. Throws the
// same exceptions as run_plans().
[[nodiscard]] std::array<RunResult, 2> run_sides(
    const SidesRun& sides, record::Store& store,
    const std::function<void(const Progress&)>& on_progress);

// Runs a single plan.
[[nodiscard]] RunResult run_plan(const Plan& plan, const std::vector<std::string>& devices,
                                 const Suite& suite, record::Store& store,
                                 const RunOptions& options,
                                 const std::function<void(const Progress&)>& on_progress);

}  // namespace triptych::measure
