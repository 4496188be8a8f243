#pragma once
// Measuring plans, for every command that does.

#include <cstdint>
#include <cstdio>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/arguments.hpp"
#include "measure/run/runner.hpp"

namespace triptych::app {

struct Measuring {
  std::vector<std::string> plans = {};    // as they were typed
  PlanChoice choice = {};                 // its --set of the only one, its shard of each
  std::vector<std::string> devices = {};  // globs
  std::string store = standard_store;
  bool resume = false;  // into the plans' latest runs, else into new ones
  std::set<std::pair<std::string, std::string>> again = {};  // as of measure::RunOptions
  int jobs = 0;                                              // likewise
  int limit_s = standard_limit_s;
  std::optional<std::uint64_t> memory = {};  // bytes that a worker may allocate
  std::vector<std::string> faults = {};
  bool measure_every = false;
  bool brief = false;                     // times are shown, and decide nothing
  bool untimed = false;                   // a frame each for the picture and the counters
  bool statistics = false;                // and one for the statistics
  bool timed = false;                     // of plans that are not judged by their times, too
  std::optional<std::string> error = {};  // that is requested, as it was typed
  bool chooses = false;                   // tells the fastest of what a plan says "auto" of
  std::FILE* told_to = stdout;
};

struct Measured {
  bool scored = false;                           // some plan's failures are told by its scores
  std::vector<measure::RunResult> results = {};  // in the order of the plans
  bool error_kept = true;  // a requested error, by every device in every scene
};

// Says in a few lines how it went. Throws as measure::run_plans does.
Measured measure_and_tell(const Measuring& measuring);

// The same for commands that have a --resume: what Interrupted says offers it.
Measured measure_resumably(const Measuring& measuring);

}  // namespace triptych::app
