#include "measure/counting/emulator.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "measure/system/cpu_features.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> environment{
    "LP_NUM_THREADS=0", "POCL_MAX_PTHREAD_COUNT=1", "POCL_CPU_MAX_CU_COUNT=1",
    "POCL_CACHE_DIR={cache}", "MESA_SHADER_CACHE_DIR={cache}"};

// Returns the version without the patch release, "3.19" for "valgrind-3.19.0".
std::string short_version(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_of("0123456789"), text.size()));
  return std::string(text.substr(0, text.find_first_not_of("0123456789", text.find('.') + 1)));
}

// Valgrind simulates a CPU with AVX2 if the machine has AVX2, and a CPU with only SSE otherwise. No
// other feature of the machine changes the simulated CPU.
std::string_view processor_name() {
  return cpu_features().find("avx2") != std::string::npos ? "AVX2" : "SSE";
}

// Returns the path of Triptych's Valgrind tool in the installation or in the build folder, or an
// empty string if the tool is missing.
std::string tool_file() {
  std::error_code error;
  const fs::path own = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder :
       {own.parent_path() / "lib" / "triptych", fs::path(TRIPTYCH_COUNTER_FOLDER)}) {
    const fs::path file = folder / "triptych_counter";
    if (fs::exists(file, error)) return file.string();
  }
  return {};
}

std::variant<Emulator, std::string> look() {
  constexpr std::string_view cannot = "cannot count instructions";
#ifndef __x86_64__
  return fmt::format("{}: counting requires an x86-64 CPU", cannot);
#endif
  const auto version = output_of({"valgrind", "--version"});
  if (!version)
    return fmt::format("{}: Valgrind does not start; install the package valgrind", cannot);
  const std::string tool = tool_file();
  if (tool.empty()) {
    return fmt::format("{}: Triptych's Valgrind tool is missing; build the target triptych_counter",
                       cannot);
  }
  Emulator found{
      .name = fmt::format("valgrind {} {}", short_version(*version), processor_name()),
      // The name of the tool determines which libraries Valgrind preloads. With "none" it preloads
      // nothing; with other names it would replace malloc. Drivers generate code at run time, so
      // Valgrind must check whether code has changed. The C and C++ libraries need not free their
      // memory at exit, because there is no leak check. If Valgrind followed jumps while it
      // translates a block, it would translate the same code several times, which takes an eighth
      // of the time of a plan that counts instructions.
      .command = {tool, "--tool=none", "--quiet", "--smc-check=all-non-file",
                  "--run-libc-freeres=no", "--run-cxx-freeres=no", "--vex-guest-chase=no"},
      // The tool is started directly, without Valgrind's launcher, and reads the
      // launcher's path from this variable.
      .environment = {"VALGRIND_LAUNCHER=/usr/bin/valgrind",
                      "VALGRIND_LIB=" TRIPTYCH_VALGRIND_FOLDER}};
  std::vector<std::string> trial = found.command;
  trial.emplace_back("/bin/true");
  if (!output_of(trial, found.environment))
    return fmt::format("{}: the Valgrind tool {} failed to run /bin/true", cannot, tool);
  return found;
}

}  // namespace

const std::variant<Emulator, std::string>& find_emulator() {
  static const std::variant<Emulator, std::string> found = look();
  return found;
}

std::vector<std::string> emulated(const Emulator& emulator, std::vector<std::string> command,
                                  std::string_view device_files) {
  std::vector<std::string> whole = emulator.command;
  whole.push_back(fmt::format("--program={}", command.front()));
  whole.push_back(fmt::format("--device-files={}", device_files));
  whole.insert(whole.end(), command.begin(), command.end());
  return whole;
}

// PoCL as Debian builds it contains one library of built-in functions for each set of CPU features.
// The environment variable selects the library, which also determines the CPU for which PoCL
// compiles kernels.
std::optional<std::vector<std::string>> compiles_for_emulator(std::string_view device) {
  if (!device.starts_with("opencl:pocl") || processor_name() != "AVX2") return std::nullopt;
  return std::vector<std::string>{"POCL_KERNELLIB_NAME=avx2"};
}

std::span<const std::string_view> counting_environment() {
  return environment;
}

}  // namespace triptych::measure
