#pragma once
// Measures plans. All commands that measure use these functions.

#include <cstdint>
#include <cstdio>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/arguments.hpp"
#include "app/ci_system.hpp"
#include "measure/run/runner.hpp"

namespace triptych::app {

struct MeasureRequest {
  std::vector<std::string> plans = {};    // as typed by the user
  PlanChoice choice = {};                 // --set for a single plan, --shard for each plan
  std::vector<std::string> devices = {};  // globs
  // Globs of devices that must be measured. If one of them cannot be used, the run records why.
  std::vector<std::string> required = {};
  std::string store = default_store;
  bool resume = false;  // continue the plans' latest runs instead of beginning new runs
  std::set<std::pair<std::string, std::string>> again = {};  // see measure::RunOptions
  int jobs = 0;                                              // see measure::RunOptions
  int limit_s = default_limit_s;
  std::optional<std::uint64_t> memory = {};  // bytes that a worker may allocate
  std::vector<std::string> faults = {};
  bool measure_every = false;
  bool brief = false;       // time only a few frames, because times do not affect the verdict
  bool untimed = false;     // draw only one frame for the image and one for the counters
  bool statistics = false;  // also read the statistics in an untimed run
  bool timed = false;       // also measure times for plans without the check `timing`
  std::optional<std::string> error = {};  // requested error, as typed by the user
  bool report_fastest = false;            // report the fastest technique if a plan contains `auto`
  bool report_unmeasured = false;         // print why configurations were skipped or failed
  bool report_clocks = false;             // report which clock the times of each device use
  bool verbose = false;                   // print a line for each configuration
  CiSystem ci = CiSystem::none;           // the CI system that shows the log
  std::FILE* summary_output = stdout;
};

struct MeasureResult {
  bool scored = false;  // whether a plan has the check `stress`, whose scores report failures
  std::vector<measure::RunResult> results = {};  // in the same order as the plans
  bool error_met = true;  // whether every device meets the requested error in every scene
};

// Measures the plans and prints a few lines about the results. Throws the same exceptions as
// measure::run_plans().
MeasureResult measure_and_print(const MeasureRequest& request);

// Like measure_and_print(), for commands with the option --resume. If the run is interrupted, the
// exception's message mentions --resume.
MeasureResult measure_resumably(const MeasureRequest& request);

}  // namespace triptych::app
