#pragma once
// The checks of a run. A plan (a set of configurations to measure) lists the checks that apply to
// it, and the judge (src/judge) has a function for each check.

#include <cstdint>
#include <set>
#include <string>
#include <string_view>

namespace triptych::record {

enum class Check : std::uint8_t {
  image,        // the image, which may differ from the reference image by at most its bound
  counters,     // Triptych's own counters, compared exactly
  statistics,   // the driver's pipeline statistics, compared exactly within a driver version
  cost,         // instructions per frame, compared within a driver version
  code,         // the GPU compiler's report, compared exactly within a driver version
  memory,       // bytes allocated on the device, compared exactly
  timing,       // frame times, which affect the verdict only if the user requests it
  correlation,  // the cost on one device as a function of the cost on another device
  accuracy,     // orders of convergence, and the error as a function of run time
  stress        // scores for stress scenes, on which renderers often fail
};
[[nodiscard]] std::string_view name_of(Check check);
[[nodiscard]] Check check(std::string_view name);  // throws InputError

using Checks = std::set<Check>;
[[nodiscard]] Checks every_check();
// Convert between checks and a comma-separated list of their names, such as "image,counters". The
// list is empty if there are no checks. checks_of() throws InputError for an unknown name.
[[nodiscard]] std::string text_of(const Checks& checks);
[[nodiscard]] Checks checks_of(std::string_view text);

}  // namespace triptych::record
