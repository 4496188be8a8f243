#pragma once
// Commands that users can copy and run.

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace triptych::report {

// The command line `triptych COMMAND OBJECT …`. `device` and `factors` may be empty.
struct Command {
  std::string command;  // such as "render"
  std::string object;   // a suite or a plan
  std::string device;
  std::map<std::string, std::string> factors;  // factor levels for --set
  std::vector<std::string> injected = {};      // faults for --inject
  // The time limit for --limit, which is printed only if it is not the default.
  std::optional<std::chrono::seconds> limit = {};
  std::vector<std::string> more = {};  // more arguments, which are appended to the command
  // Environment variables, which are printed before the command.
  std::map<std::string, std::string> environment = {};
};

// Returns the environment variables of a device that a printed command may set. The variables come
// from a store, which anybody may have written, and users run the printed command. Therefore a
// variable that can name code to load, such as LD_PRELOAD or VK_DRIVER_FILES, is printed only if it
// has the same value in this process. Settings of known drivers that do not name a file are always
// printed.
[[nodiscard]] std::map<std::string, std::string> allowed_environment(
    std::map<std::string, std::string> environment);

// Returns the names of the variables that allowed_environment() removes.
[[nodiscard]] std::vector<std::string> omitted_variables(
    const std::map<std::string, std::string>& environment);

// Returns the command as shell input.
[[nodiscard]] std::string text_of(const Command& command);

}  // namespace triptych::report
