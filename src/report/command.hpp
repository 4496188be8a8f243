#pragma once
// Commands that users can paste.

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace triptych::report {

// `triptych COMMAND OBJECT`, for one configuration on one device if these are given.
struct Command {
  std::string command;  // "render"
  std::string object;   // a suite or a plan
  std::string device;
  std::map<std::string, std::string> factors;  // only factors without their default level
  std::vector<std::string> injected = {};      // faults
  // The time limit of a frame, if it is not the default.
  std::optional<std::chrono::seconds> limit = {};
  std::vector<std::string> more = {};  // words at the end of the command
  // Variables that are set for the device's driver.
  std::map<std::string, std::string> environment = {};
};

// The variables of a device that a printed command may set. They come from a store, which anybody
// may have written, and users paste the command. Therefore a variable that names code to load, such
// as LD_PRELOAD or VK_DRIVER_FILES, is repeated only if it is set to the same value in this
// process. Settings of known drivers that do not name a file are always repeated.
[[nodiscard]] std::map<std::string, std::string> repeatable(
    std::map<std::string, std::string> environment);

// The command for a shell, with the variables before it.
[[nodiscard]] std::string text_of(const Command& command);

}  // namespace triptych::report
