#pragma once
// The supervisor's part in counting instructions: it starts a worker under Valgrind with Triptych's
// own tool (counting/tool.c). Available only for x86-64.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace triptych::measure {

struct Emulator {
  // The emulator and the CPU that it simulates, such as "valgrind 3.19 AVX2". Counts from different
  // emulators are not compared. The name does not contain the patch release, because patch releases
  // do not change counts.
  std::string name;
  std::vector<std::string> command;      // placed before a worker's command
  std::vector<std::string> environment;  // "NAME=VALUE" strings for the command
};

// Returns the emulator, or a line that states why instructions cannot be counted and what to
// install. The search takes place only once per process.
[[nodiscard]] const std::variant<Emulator, std::string>& find_emulator();

// Returns `command` preceded by the emulator's command. Code in files mapped from the folder
// `device_files`, such as PoCL's kernels, counts as device code.
[[nodiscard]] std::vector<std::string> emulated(const Emulator& emulator,
                                                std::vector<std::string> command,
                                                std::string_view device_files);

// Some drivers compile for the CPU that an environment variable names. Returns the variables, as
// "NAME=VALUE", with which the driver of this device compiles for the simulated CPU even if the
// process runs without the emulator. Returns nullopt if the driver has no such variable, or if no
// value of the variable selects the simulated CPU.
[[nodiscard]] std::optional<std::vector<std::string>> compiles_for_emulator(
    std::string_view device);

// Returns environment variables as "NAME=VALUE", which override the caller's variables. They limit
// drivers to one thread, so that a count does not depend on the number of CPU cores. They also give
// drivers a separate cache folder, because the cached code is compiled for the simulated CPU.
// "{cache}" in a value stands for that folder.
[[nodiscard]] std::span<const std::string_view> counting_environment();

}  // namespace triptych::measure
