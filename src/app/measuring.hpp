#pragma once
// Measuring from within other commands.

#include <string>
#include <vector>

namespace triptych::app {

// Measures plans on the devices of some globs, each into a new run or, with `resume`, into its
// latest, as `triptych run` does and tells it. The number of configurations measured or failed of
// each. Throws as measure::run_plans does; interrupted, an Error that offers --resume.
[[nodiscard]] std::vector<int> measure_plans(const std::vector<std::string>& plans,
                                             const std::vector<std::string>& devices,
                                             const std::string& store, bool resume);

}  // namespace triptych::app
