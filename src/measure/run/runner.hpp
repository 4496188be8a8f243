#pragma once
// Runs a plan: one worker process per device, supervised; records are stored as they are made.

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
  // Of one configuration; a worker past it is killed and replaced.
  std::chrono::seconds limit = record::standard_limit;
  std::chrono::seconds start_limit{60};  // of opening a device and calibrating its clocks
  bool resume = false;  // continue the plan's latest run: what has a record is left alone
  // Device and configuration of records that a resumed run holds and yet draws again.
  std::set<std::pair<std::string, std::string>> again = {};
  std::vector<InjectedFault> faults;
  // Workers at once, of one device too, where nothing is timed; 0: one of each device, as many
  // devices as there are processors.
  int jobs = 0;
  std::vector<std::string> worker_command;           // as SideOptions::command
  std::vector<std::string> worker_environment = {};  // as SideOptions::environment
  // What the command was asked for and found; its devices are those that are measured.
  record::Beginning begun = {};
  std::string program = {};  // the version, with its commit, that a run says; empty: the version
};

struct Progress {
  std::string device;
  std::string configuration;
  int done = 0;
  int total = 0;
  std::chrono::seconds left{0};
  const record::Record* record = nullptr;  // of the configuration just done
  std::optional<Loading> loading;          // else: of the configuration under way
};

struct RunResult {
  std::string run;  // id in the store
  // What the run holds of the plan on its devices: with `resume`, from before too.
  int measured = 0;
  int taken_over =
      0;  // of those, by another configuration's frames (measure/contract/equivalents.hpp)
  int skipped = 0;
  int failed = 0;        // failed, crashed, hung or lost
  int there_before = 0;  // of all these, those that a resumed run held already
  double wall_ns = 0;
  double devices_ns = 0;   // wall clock of all devices' parts: more than wall_ns, side by side
  double overhead_ns = 0;  // of devices_ns, what was neither opening devices, preparing nor frames
};

// In a few lines: the plan's run in the store's file, and how it went.
[[nodiscard]] std::string describe(const RunResult& result, const std::string& plan,
                                   const std::string& store);

// One plan of those that are measured together.
struct PlannedRun {
  const Plan& plan;
  const Suite& suite;
  const RunOptions& options;
};

// Every configuration of each plan on every device, devices one after the other so that none
// disturbs another's timing. A crash, a hang or a lost device costs one configuration; a device
// whose worker cannot be started twice in a row costs the device, each of its configurations failed
// with the reason. One result per plan, each of a run of its own. Throws InputError for an unknown
// fault, for an environment that forbids measuring, and for a resumed run whose device has changed
// or that holds what its plan, changed since, does not measure; IoError when the store cannot be
// written; Interrupted.
[[nodiscard]] std::vector<RunResult> run_plans(
    std::span<const PlannedRun> runs, const std::vector<std::string>& devices, record::Store& store,
    const std::function<void(const Progress&)>& on_progress);

// Faults of these runs that are meant for none of their configurations on these devices: who
// injects one and sees a pass would think that it was not caught.
[[nodiscard]] std::vector<InjectedFault> faults_that_hit_nothing(
    std::span<const PlannedRun> runs, const std::vector<std::string>& devices);

// A plan on two sides, each into a run of its own.
struct SidesRun {
  const Plan& plan;
  const Suite& suite;
  std::array<std::string, 2> devices;
  std::array<RunOptions, 2> options;
};

// Side by side where nothing is timed, else one after the other. Throws as run_plans().
[[nodiscard]] std::array<RunResult, 2> run_sides(
    const SidesRun& sides, record::Store& store,
    const std::function<void(const Progress&)>& on_progress);

// One alone.
[[nodiscard]] RunResult run_plan(const Plan& plan, const std::vector<std::string>& devices,
                                 const Suite& suite, record::Store& store,
                                 const RunOptions& options,
                                 const std::function<void(const Progress&)>& on_progress);

}  // namespace triptych::measure
