#pragma once
// Measuring from within other commands.

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/arguments.hpp"

namespace triptych::app {

struct Measuring {
  std::vector<std::string> plans;    // as they were typed
  PlanChoice choice = {};            // its --set of the only one, its shard of each
  std::vector<std::string> devices;  // globs
  std::string store;
  bool resume = false;  // into the plans' latest runs, else into new ones
  std::set<std::pair<std::string, std::string>> again = {};  // as of measure::RunOptions
  int jobs = 0;                                              // likewise
  std::vector<std::string> faults = {};
  bool brief = false;    // times are shown, and decide nothing
  bool untimed = false;  // a frame each for the picture, the counters and the statistics
};

// Measures as `triptych run` does and tells it on standard error. Throws as measure::run_plans
// does; what Interrupted says offers --resume.
void measure_plans(const Measuring& measuring);

}  // namespace triptych::app
