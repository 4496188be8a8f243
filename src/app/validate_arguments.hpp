#pragma once
// The arguments of `triptych validate`.

#include <string>
#include <vector>

#include "app/arguments.hpp"
#include "app/ci_system.hpp"
#include "app/paths.hpp"

namespace triptych::app {

struct ValidateArguments {
  std::vector<std::string> devices;
  std::string out = "validation";
  std::string baselines = default_baselines().string();
  std::string junit;
  std::string json;
  PlanChoice choice;  // --set is not offered by this command
  int jobs = 0;       // see measure::RunOptions
  int limit_s = default_limit_s;
  std::string expect;
  std::string write_expect;
  bool resume = false;
  int repeat = 1;
  bool without_data = false;
  bool verbose = false;
  std::string ci = default_ci;
};

// Returns the command that continues an interrupted validation. It contains all options that affect
// which configurations are measured and how they are judged.
[[nodiscard]] std::string resume_command(const ValidateArguments& arguments);

}  // namespace triptych::app
