#pragma once
// Measuring from within other commands.

#include <string>
#include <vector>

#include "core/error.hpp"

namespace triptych::app {

// Measures plans on the devices of some globs, each into a new run, as `triptych run --rounds 1`
// does and tells it: where no time is judged one round will do. The number of configurations
// measured or failed of each. Throws as measure::run_plans does.
[[nodiscard]] std::vector<int> measure_plans_once(const std::vector<std::string>& plans,
                                                  const std::vector<std::string>& devices,
                                                  const std::string& store);

// As a CTest fixture does: a plan on one device, by a worker of its own, into the store's latest
// run of the plan or a new one; the anchors with it where a correlation will be drawn. A
// configuration that failed makes it a regression, nothing but skips a skip. Throws as
// measure::run_plans does.
[[nodiscard]] core::ExitCode measure_as_test(const std::string& plan, const std::string& device,
                                             const std::string& store);

}  // namespace triptych::app
