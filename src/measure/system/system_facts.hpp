#pragma once

#include <map>
#include <string>

namespace triptych::measure {

// Returns facts about this machine (CPU, cores, memory, operating system, kernel), the compiler
// that built Triptych, and the version of Triptych.
[[nodiscard]] std::map<std::string, std::string> system_facts();
// Returns the host name of the machine, or an empty string if it is unknown.
[[nodiscard]] std::string host_name();

}  // namespace triptych::measure
