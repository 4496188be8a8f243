#pragma once

#include <map>
#include <optional>
#include <string>

namespace triptych::measure {

// Returns facts about this machine (CPU, cores, memory, operating system, kernel), the compiler
// that built Triptych, and the version of Triptych.
[[nodiscard]] std::map<std::string, std::string> system_facts();
// Returns how many threads other than the calling thread are running or ready to run on this
// machine, divided by the number of its CPU cores. Returns nullopt if this is unknown.
[[nodiscard]] std::optional<double> other_runnable_threads_per_core();
// Returns the host name of the machine, or an empty string if it is unknown.
[[nodiscard]] std::string host_name();

}  // namespace triptych::measure
