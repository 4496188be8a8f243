#pragma once
// The two sides of a comparison (two devices, drivers or builds), as specified on the command line.

#include <cstdint>
#include <string>
#include <vector>

#include "app/arguments.hpp"
#include "measure/worker/worker_setup.hpp"

namespace triptych::app {

// The plans that `gate` and `compare` use by default. The first two check images, work and times;
// the last two count instructions.
extern const std::vector<std::string> default_plans;

struct ComparisonRequest {
  std::vector<std::string> plans;  // as typed by the user; empty: default_plans
  PlanChoice choice = {};
  measure::SideOptions a;
  measure::SideOptions b;
  std::string sides;                     // the options that select the sides: "--a … --b …"
  std::vector<std::string> faults = {};  // injected into side b
  std::string store = {};                // file that receives both runs of each plan; empty: none
  int budget_s = 0;                      // in seconds; 0: no limit
  int limit_s = default_limit_s;
  std::uint64_t seed = 1;
  bool times = true;
  bool verbose = false;
  bool base = false;  // whether side a is the argument of `gate --base`
};

// Compares the sides, prints the differences, and returns the exit code for all comparisons.
[[nodiscard]] core::ExitCode compare_and_print(const std::vector<ComparisonRequest>& comparisons,
                                               bool json);

// Returns the worker command (see measure::worker_command) of another build. Throws InputError with
// the option's name if the file is not an executable build of triptych. Without this check, a
// program that never responds would be reported as a failure of the device.
[[nodiscard]] std::vector<std::string> worker_of(const std::string& option,
                                                 const std::string& program);

// Returns the comparisons of each device with the same device under `base`, which is the path of
// another build or "NAME=VALUE,…".
[[nodiscard]] std::vector<ComparisonRequest> comparisons_with_base(
    const std::string& base, const std::vector<std::string>& devices);

}  // namespace triptych::app
