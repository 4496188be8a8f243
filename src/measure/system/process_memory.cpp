#include "measure/system/process_memory.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace triptych::measure {
namespace {

// Returns a size in bytes from /proc/self/status, such as that of "VmRSS:".
std::optional<std::uint64_t> process_status_bytes(std::string_view name) {
  std::ifstream lines("/proc/self/status");
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(name)) return std::stoull(line.substr(name.size())) * 1024;
  }
  return std::nullopt;
}

}  // namespace

// ru_maxrss is used only if /proc is unavailable, because exec() does not reset it: a worker would
// begin with the peak of its supervisor.
std::uint64_t peak_memory_bytes() {
  if (const auto peak = process_status_bytes("VmHWM:")) return *peak;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t resident_memory_bytes() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
  return process_status_bytes("VmRSS:").value_or(0);
}

}  // namespace triptych::measure
