#pragma once
// The supervisor's part in counting instructions: a worker is started under Valgrind with
// Triptych's own tool (counting/tool.c). Only for x86-64.

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace triptych::measure {

struct Emulator {
  // The emulator and the processor that it simulates, such as "valgrind 3.19 AVX2". Counts from
  // different emulators are not compared. Patch releases are left out, because they do not change
  // counts.
  std::string name;
  std::vector<std::string> command;      // placed before a worker's command
  std::vector<std::string> environment;  // "NAME=VALUE", for the command
};

// Returns the emulator, or one line that states why instructions cannot be counted and what to
// install. The search is done only once per process.
[[nodiscard]] const std::variant<Emulator, std::string>& find_emulator();

// Returns `command` preceded by the emulator's command. Code in files that are mapped from the
// folder `device_files`, such as PoCL's kernels, counts as device code.
[[nodiscard]] std::vector<std::string> emulated(const Emulator& emulator,
                                                std::vector<std::string> command,
                                                std::string_view device_files);

// Returns environment variables as "NAME=VALUE", which override those of the caller. They limit
// drivers to one thread, so that a count does not depend on the number of processors. They also
// give drivers a separate cache folder, because their code is compiled for the simulated processor.
// "{cache}" in a value stands for that folder.
[[nodiscard]] std::span<const std::string_view> counting_environment();

}  // namespace triptych::measure
