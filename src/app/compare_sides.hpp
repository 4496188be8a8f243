#pragma once
// The two sides of a comparison, as commands see them.

#include <cstdint>
#include <string>
#include <vector>

#include "app/arguments.hpp"
#include "measure/worker/worker_setup.hpp"

namespace triptych::app {

// The plans that a gate and a comparison use by default: images, work and times, then instructions.
extern const std::vector<std::string> main_job;

struct Comparing {
  std::vector<std::string> plans;  // as typed by the user; empty: the default plans
  PlanChoice choice = {};
  measure::SideOptions a;
  measure::SideOptions b;
  std::string sides;                     // names the sides on a command line, "--a … --b …"
  std::vector<std::string> faults = {};  // injected into side b
  std::string store = {};                // keeps both runs of each plan; empty: nothing is kept
  int budget_s = 0;                      // in seconds; 0: none
  int limit_s = standard_limit_s;
  std::uint64_t seed = 1;
  bool times = true;
  bool verbose = false;
};

// Compares, prints the differences and returns the exit code over all comparisons.
[[nodiscard]] core::ExitCode compare_and_tell(const std::vector<Comparing>& comparisons, bool json);

// The measure::worker_command of another build. Throws InputError with the option's name if the
// file is not an executable build of triptych. Without this check, the missing answer would be
// reported as a failure of the device.
[[nodiscard]] std::vector<std::string> worker_of(const std::string& option,
                                                 const std::string& program);

// Compares each device with itself under `base`: the program of another build, or "NAME=VALUE,…".
[[nodiscard]] std::vector<Comparing> against_base(const std::string& base,
                                                  const std::vector<std::string>& devices);

}  // namespace triptych::app
