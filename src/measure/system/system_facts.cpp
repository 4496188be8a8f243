#include "measure/system/system_facts.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "measure/system/cpu_features.hpp"
#include "record/driver_variables.hpp"

namespace triptych::measure {
namespace {

// Returns the value in the first line of the form "KEY<blanks><separator> VALUE", without quotation
// marks, or an empty string if there is no such line.
std::string value_in(const char* file, std::string_view key, char separator) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const auto split = line.find(separator);
    if (split == std::string::npos) continue;
    if (line.substr(0, line.find_last_not_of(" \t", split - 1) + 1) != key) continue;
    const auto first = line.find_first_not_of(" \t\"", split + 1);
    const auto last = line.find_last_not_of(" \t\"");
    return first == std::string::npos ? std::string() : line.substr(first, last - first + 1);
  }
  return {};
}

std::string first_line(const char* file) {
  std::ifstream lines(file);
  std::string line;
  std::getline(lines, line);
  return line;
}

// Returns the number of CPU cores on which this process may run. Drivers use this number as the
// size of their thread pools. It may be smaller than the number of cores of the machine.
int usable_cores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  return ::sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 0;
}

std::string_view compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "";
#endif
}

}  // namespace

std::optional<double> other_runnable_threads_per_core() {
  // The fourth word of the file is "RUNNABLE/ALL", the numbers of threads on this machine.
  std::ifstream file("/proc/loadavg");
  std::string average;
  int runnable = 0;
  const long cores = ::sysconf(_SC_NPROCESSORS_ONLN);
  if (!(file >> average >> average >> average >> runnable) || cores <= 0) return std::nullopt;
  return static_cast<double>(std::max(0, runnable - 1)) / static_cast<double>(cores);
}

std::string host_name() {
  utsname names{};
  return ::uname(&names) == 0 ? names.nodename : "";
}

std::map<std::string, std::string> system_facts() {
  std::map<std::string, std::string> facts{
      {"processor", value_in("/proc/cpuinfo", "model name", ':')},
      {"os", value_in("/etc/os-release", "PRETTY_NAME", '=')},
      {"frequency_governor", first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")},
      {"compiler", std::string(compiler())},
      {"triptych", TRIPTYCH_VERSION},
      {"google_benchmark", TRIPTYCH_BENCHMARK_VERSION}};
  if (const int cores = usable_cores(); cores > 0) facts["cores"] = fmt::format("{}", cores);
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page_bytes = ::sysconf(_SC_PAGESIZE);
  if (pages > 0 && page_bytes > 0) {
    facts["memory_bytes"] = fmt::format(
        "{}", static_cast<unsigned long long>(pages) * static_cast<unsigned long long>(page_bytes));
  }
  if (utsname names{}; ::uname(&names) == 0) {
    facts["host"] = names.nodename;
    facts["kernel"] = fmt::format("{} {} {}", names.sysname, names.release, names.machine);
  }
  for (const record::DriverVariable& each : record::driver_variables) {
    const std::string name(each.name);
    if (const char* value = std::getenv(name.c_str())) facts[name] = value;
  }
  std::erase_if(facts, [](const auto& fact) { return fact.second.empty(); });
  return facts;
}

}  // namespace triptych::measure
