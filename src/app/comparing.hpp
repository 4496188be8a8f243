#pragma once
// Two sides of a comparison from within commands.

#include <cstdint>
#include <string>
#include <vector>

#include "app/arguments.hpp"
#include "measure/worker/worker_setup.hpp"

namespace triptych::app {

// What a gate and a comparison without plans are about: pictures, work and times, then
// instructions.
extern const std::vector<std::string> main_job;

struct Comparing {
  std::vector<std::string> plans;  // as they were typed; empty: the main job
  PlanChoice choice = {};
  measure::SideOptions a;
  measure::SideOptions b;
  std::string sides;                     // what names them on a command line, "--a … --b …"
  std::vector<std::string> faults = {};  // into b
  std::string store = {};                // keeps both runs of each plan; empty: nothing does
  int budget_s = 0;                      // none
  int limit_s = standard_limit_s;
  std::uint64_t seed = 1;
  bool times = true;
};

// Compares, prints what was found and returns the exit code that counts over all.
[[nodiscard]] core::ExitCode compare_and_tell(const std::vector<Comparing>& comparisons, bool json);

// measure::worker_command of another build. Throws InputError naming the option where the file is
// no program, or one that is no triptych: its device would be blamed for what it does not answer.
[[nodiscard]] std::vector<std::string> worker_of(const std::string& option,
                                                 const std::string& program);

// Each device against itself by `base`: the program of another build, or "NAME=VALUE,…".
[[nodiscard]] std::vector<Comparing> against_base(const std::string& base,
                                                  const std::vector<std::string>& devices);

}  // namespace triptych::app
