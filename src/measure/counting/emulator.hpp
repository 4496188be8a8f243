#pragma once
// The supervisor's side of counting instructions: it starts a worker under Valgrind with Triptych's
// own tool (counting/tool.c). x86-64 only.

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace triptych::measure {

struct Emulator {
  // The emulator and the processor that it simulates, "valgrind 3.19 AVX2". Counts by different
  // emulators are not compared. Patch releases are left out, because they do not change counts.
  std::string name;
  std::vector<std::string> command;      // placed before a worker's command
  std::vector<std::string> environment;  // "NAME=VALUE", for the command
};

// The emulator, or one line of text with the reason why nothing can be counted and what to install.
// The search is made once per process.
[[nodiscard]] const std::variant<Emulator, std::string>& find_emulator();

// Returns `command` preceded by the emulator's command. Code in mapped files in the folder
// `device_files` counts as device code (PoCL's kernels).
[[nodiscard]] std::vector<std::string> emulated(const Emulator& emulator,
                                                std::vector<std::string> command,
                                                std::string_view device_files);

// "NAME=VALUE" settings that override the caller's: one thread, so that a count does not depend on
// the number of processors, and a separate folder for the drivers' caches, because the code is
// compiled for another processor than natively. "{cache}" in a value stands for that folder.
[[nodiscard]] std::span<const std::string_view> counting_environment();

}  // namespace triptych::measure
