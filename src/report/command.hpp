#pragma once
// Commands to paste.

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace triptych::report {

// `triptych COMMAND OBJECT`, of one configuration on one device where these are given.
struct Command {
  std::string command;  // "render"
  std::string object;   // a suite or a plan
  std::string device;
  std::map<std::string, std::string> factors;           // that have not their defaults
  std::vector<std::string> injected = {};               // faults
  std::optional<std::chrono::seconds> limit = {};       // of one frame, where it is not the usual
  std::vector<std::string> more = {};                   // words at the end
  std::map<std::string, std::string> environment = {};  // set for the device
};

// The variables of a device that a command may repeat. They come from a store, which anybody may
// have written, and the command is pasted: a variable that names code to load, such as LD_PRELOAD or
// VK_DRIVER_FILES, is repeated only where it is set to the same value here. Settings of the known
// drivers that name no file are always repeated.
[[nodiscard]] std::map<std::string, std::string> repeatable(
    std::map<std::string, std::string> environment);

// As a shell reads it, the environment before it.
[[nodiscard]] std::string text_of(const Command& command);

}  // namespace triptych::report
