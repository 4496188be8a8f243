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
  std::map<std::string, std::string> factors;           // those that do not have their defaults
  std::vector<std::string> injected = {};               // faults
  std::optional<std::chrono::seconds> limit = {};       // for one frame, if it is not the usual one
  std::vector<std::string> more = {};                   // words at the end of the command
  std::map<std::string, std::string> environment = {};  // variables that are set for the device
};

// The variables of a device that a command may repeat. They come from a store, which anybody may
// have written, and users paste the command. So a variable that names code to load, such as
// LD_PRELOAD or VK_DRIVER_FILES, is repeated only if it is set to the same value in this process.
// Settings of known drivers that do not name a file are always repeated.
[[nodiscard]] std::map<std::string, std::string> repeatable(
    std::map<std::string, std::string> environment);

// The command for a shell, with the variables before it.
[[nodiscard]] std::string text_of(const Command& command);

}  // namespace triptych::report
