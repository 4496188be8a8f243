#pragma once

#include <map>
#include <string>

namespace triptych::measure {

// Processor, cores, memory, operating system, kernel, compiler, version of Triptych.
[[nodiscard]] std::map<std::string, std::string> system_facts();
// The name of the machine; empty if it has none.
[[nodiscard]] std::string host_name();

}  // namespace triptych::measure
