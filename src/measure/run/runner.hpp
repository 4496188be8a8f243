#pragma once
// Runs plans in supervised worker processes, each of which uses one device. Records are stored as
// soon as they are complete.

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
  std::chrono::seconds limit = record::default_limit;
  std::chrono::seconds start_limit{60};  // time limit for opening a device and calibrating
  bool resume = false;                   // continues the plan's latest run and keeps its records
  // The device and the configuration of each record that is to be measured again although a resumed
  // run already contains it.
  std::set<std::pair<std::string, std::string>> remeasure = {};
  std::vector<InjectedFault> faults;
  // The maximum number of workers that run at the same time if nothing is timed. One device may
  // have several workers. 0: one worker for each device (two in a plan that only compiles), but not
  // more than there are CPU cores.
  int jobs = 0;
  std::vector<std::string> worker_command;           // see SideOptions::command
  std::vector<std::string> worker_environment = {};  // see SideOptions::environment
  // The devices that the command requested, the devices that it found, and the devices that it
  // measures.
  record::RunStart begun = {};
  // The version of the program, including its commit, which is stored in the run. If this is empty,
  // only the version number is stored.
  std::string program = {};
};

struct Progress {
  std::string device;
  std::string configuration;
  int done = 0;
  int total = 0;
  std::chrono::seconds left{0};
  const record::Record* record = nullptr;  // the record that was just completed
  std::optional<Loading> loading;          // if `record` is null: progress of loading the data
};

struct RunResult {
  std::string run;  // id of the run in the store
  // The number of records with each outcome, on all devices. If a run was resumed, this includes
  // its earlier records.
  int measured = 0;
  // The number of measured records whose results were copied from an equivalent configuration
  // (measure/contract/equivalents.hpp).
  int copied = 0;
  int skipped = 0;
  int failed = 0;          // number of records that failed, crashed, hung or lost the device
  int already_stored = 0;  // number of records that the resumed run already contained
  double wall_ns = 0;
  // The sum of the wall-clock times of all devices. It exceeds wall_ns if devices were measured in
  // parallel.
  double devices_ns = 0;
  // The part of devices_ns that was spent on anything other than opening devices, preparing and
  // drawing.
  double overhead_ns = 0;
};

// Returns a few lines that describe the result of a plan's run. `store` is the file of the store.
[[nodiscard]] std::string describe(const RunResult& result, const std::string& plan,
                                   const std::string& store);

// A plan that is measured together with other plans.
struct PlannedRun {
  const Plan& plan;
  const Suite& suite;
  const RunOptions& options;
};

// Measures every configuration of each plan on every device. Each plan has its own run and its own
// result. If times are measured, the devices are measured one after the other, so that they do not
// disturb each other. A crash, a hang or a lost device affects only one configuration. If two
// attempts in a row to start a device's worker fail, all remaining configurations of the device
// fail with the same reason.
//
// Throws InputError for an unknown fault, for environment variables that must not be set while
// measuring, for a resumed run whose device has changed, and for a resumed run that contains
// configurations that the changed plan no longer contains. Throws IoError if the store cannot be
// written. Throws Interrupted if a signal asks the program to stop.
[[nodiscard]] std::vector<RunResult> run_plans(
    std::span<const PlannedRun> runs, const std::vector<std::string>& devices, record::Store& store,
    const std::function<void(const Progress&)>& on_progress);

// Returns the injected faults that do not apply to any of the configurations on these devices. They
// must be reported, because otherwise a user who injects a fault and sees a pass would think that
// the fault was not detected.
[[nodiscard]] std::vector<InjectedFault> unmatched_faults(std::span<const PlannedRun> runs,
                                                          const std::vector<std::string>& devices);

// A plan that is measured on two sides: on two devices, or on one device with different driver
// settings or builds. Each side is written to its own run.
struct SidesRun {
  const Plan& plan;
  const Suite& suite;
  std::array<std::string, 2> devices;
  std::array<RunOptions, 2> options;
};

// Measures both sides: one after the other if times are measured, and otherwise in parallel. Throws
// the same exceptions as run_plans().
[[nodiscard]] std::array<RunResult, 2> run_sides(
    const SidesRun& sides, record::Store& store,
    const std::function<void(const Progress&)>& on_progress);

// Runs a single plan.
[[nodiscard]] RunResult run_plan(const Plan& plan, const std::vector<std::string>& devices,
                                 const Suite& suite, record::Store& store,
                                 const RunOptions& options,
                                 const std::function<void(const Progress&)>& on_progress);

}  // namespace triptych::measure
