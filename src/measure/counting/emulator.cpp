#include "measure/counting/emulator.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "measure/environment.hpp"
#include "measure/process.hpp"

namespace triptych::measure {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view qemu = "qemu-x86_64";

// AVX2 and FMA, as drivers use them, and the same on every machine. What QEMU does not have of it
// is taken out, or it would warn.
constexpr std::string_view processor_name = "Haswell";
constexpr std::string_view processor = "Haswell-noTSX,-pcid,-x2apic,-tsc-deadline,-invpcid";

// Versions of the plugin interface that a plugin is built for; each emulator takes some of them.
constexpr std::array<int, 3> plugin_versions{1, 2, 4};

constexpr std::array<std::string_view, 5> environment{
    "LP_NUM_THREADS=0", "POCL_MAX_PTHREAD_COUNT=1", "POCL_CPU_MAX_CU_COUNT=1",
    "POCL_CACHE_DIR={cache}", "MESA_SHADER_CACHE_DIR={cache}"};

// All that a short program prints; nullopt where it cannot be started, fails or takes too long.
std::optional<std::string> output_of(const std::vector<std::string>& command) {
  constexpr std::chrono::seconds patience{20};
  try {
    std::vector<std::string> variables;
    for (char** entry = environ; *entry != nullptr; ++entry) variables.emplace_back(*entry);
    Process process(command, variables);
    const std::optional<Exit> exit = process.wait(patience);
    if (!exit || exit->code != 0 || exit->signal != 0) return std::nullopt;
    std::string text(4096, '\0');
    const ssize_t got = ::read(process.log_fd(), text.data(), text.size());
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return text;
  } catch (const core::IoError&) {
    return std::nullopt;
  }
}

// "qemu-x86_64 version 7.2.22 (Debian …)" → "7.2".
std::string short_version(std::string_view text) {
  constexpr std::string_view before = "version ";
  const std::size_t start = text.find(before);
  if (start == std::string_view::npos) return "of unknown version";
  text.remove_prefix(start + before.size());
  const std::size_t major = text.find('.');
  const std::size_t end = text.find_first_not_of("0123456789", major + 1);
  return std::string(text.substr(0, end));
}

// Beside the program where it was built, or where it was installed.
std::vector<fs::path> plugin_folders() {
  std::error_code error;
  const fs::path own = fs::read_symlink("/proc/self/exe", error).parent_path();
  return {own.parent_path() / "lib" / "triptych", fs::path(TRIPTYCH_PLUGIN_FOLDER)};
}

// QEMU reads a comma as the end of a value unless it is doubled.
std::string as_value(std::string_view text) {
  std::string value;
  for (const char c : text) value += c == ',' ? ",," : std::string(1, c);
  return value;
}

std::variant<Emulator, std::string> look() {
  const auto version = output_of({std::string(qemu), "--version"});
  if (!version) {
    return fmt::format("instructions cannot be counted: {} is not to be started; install qemu-user",
                       qemu);
  }
  const std::string name = fmt::format("qemu {} {}", short_version(*version), processor_name);
  // Debian 13 links it statically, and then QEMU has no option for plugins.
  const auto help = output_of({std::string(qemu), "-h"});
  if (help && help->find("-plugin") == std::string::npos) {
    return fmt::format("instructions cannot be counted: {} has no plugins; see docs/ci.md", name);
  }
  bool any = false;
  for (const fs::path& folder : plugin_folders()) {
    for (const int api : plugin_versions) {
      const fs::path plugin = folder / fmt::format("triptych_counter_{}.so", api);
      if (!fs::exists(plugin)) continue;
      any = true;
      if (output_of({std::string(qemu), "-plugin", as_value(plugin.string()), "/bin/true"})) {
        return Emulator{.program = std::string(qemu), .plugin = plugin.string(), .name = name};
      }
    }
  }
  return any ? fmt::format("instructions cannot be counted: {} takes none of the plugin's versions",
                           name)
             : std::string(
                   "instructions cannot be counted: the plugin triptych_counter is missing");
}

}  // namespace

const std::variant<Emulator, std::string>& find_emulator() {
  static const std::variant<Emulator, std::string> found = look();
  return found;
}

std::vector<std::string> emulated(const Emulator& emulator, std::vector<std::string> command,
                                  std::string_view device_files) {
  const std::string plugin = fmt::format("{},program={},device={}", as_value(emulator.plugin),
                                         as_value(command.front()), as_value(device_files));
  command.insert(command.begin(),
                 {emulator.program, "-cpu", std::string(processor), "-plugin", plugin});
  return command;
}

std::span<const std::string_view> counting_environment() {
  return environment;
}

}  // namespace triptych::measure
