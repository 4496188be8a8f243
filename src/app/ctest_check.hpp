#pragma once
// One check of one plan as a CTest test.

#include <string>

#include "core/error.hpp"

namespace triptych::app {

struct CheckArguments {
  std::string plan;
  std::string check;   // by name
  std::string device;  // id; empty: all
  std::string store;
};

// Judges the plan's latest run in the store, and measures devices that are called slower once more.
// What failed is told on standard output. Skips where nothing was judged, and where a failure would
// be that of a slow or noisy machine or of files that are not here.
[[nodiscard]] core::ExitCode check_as_test(const CheckArguments& arguments);

}  // namespace triptych::app
