#pragma once
// The supervisor's side of counting: Valgrind with a tool of ours (counting/tool.c), under which a
// worker is started so that its instructions are counted. x86-64 only.

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace triptych::measure {

struct Emulator {
  // Emulator and processor shown, "valgrind 3.19 AVX2": counts of one are not compared with
  // another's. Patch releases are left out, as they change no count.
  std::string name;
  std::vector<std::string> command;      // goes before a worker's
  std::vector<std::string> environment;  // "NAME=VALUE", for the command
};

// What there is, or in one line why nothing can be counted and what to install. Looked for once in
// a process.
[[nodiscard]] const std::variant<Emulator, std::string>& find_emulator();

// `command` with the emulator before it. `device_files`: the folder whose mapped files are device
// code, PoCL's kernels.
[[nodiscard]] std::vector<std::string> emulated(const Emulator& emulator,
                                                std::vector<std::string> command,
                                                std::string_view device_files);

// "NAME=VALUE", over what the caller has set: one thread, so that the number of processors is no
// part of a count, and drivers' caches in a folder of their own, as code is made for another
// processor than natively. "{cache}" in a value stands for that folder.
[[nodiscard]] std::span<const std::string_view> counting_environment();

}  // namespace triptych::measure
