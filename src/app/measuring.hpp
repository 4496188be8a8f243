#pragma once
// Measuring from within other commands.

#include <string>
#include <vector>

#include "core/error.hpp"

namespace triptych::app {

// Measures plans on the devices of some globs, each into a new run or, with `resume`, into its
// latest, as `triptych run --rounds 1` does and tells it: where no time is judged one round will
// do. The number of configurations measured or failed of each. Throws as measure::run_plans does;
// interrupted, an Error that offers --resume.
[[nodiscard]] std::vector<int> measure_plans_once(const std::vector<std::string>& plans,
                                                  const std::vector<std::string>& devices,
                                                  const std::string& store, bool resume);

// Measures a plan once more on these devices (globs), with the anchors where the store holds any,
// to confirm the plan's latest run there. Throws as measure::run_plans does.
void measure_again(const std::string& plan, const std::vector<std::string>& devices,
                   const std::string& store);

}  // namespace triptych::app
