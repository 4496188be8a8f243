#pragma once
// Measuring as a CTest fixture does.

#include <string>

#include "core/error.hpp"

namespace triptych::app {

// Measures a plan on one device, by a worker of its own, into the store's latest run of the plan or
// a new one; the anchors before it where a correlation will be drawn. A configuration that failed
// makes it a regression, nothing but skips a skip. Throws as measure::run_plan does.
[[nodiscard]] core::ExitCode measure_as_test(const std::string& plan, const std::string& device,
                                             const std::string& store);

}  // namespace triptych::app
