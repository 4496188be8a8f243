#pragma once
// The checks by which a run can be judged. A plan lists its checks, and the judge has a function
// for each.

#include <cstdint>
#include <set>
#include <string>
#include <string_view>

namespace triptych::record {

enum class Check : std::uint8_t {
  image,        // against the reference, within a derived bound
  counters,     // Triptych's own counters, exact
  statistics,   // the driver's pipeline statistics, exact by driver version
  cost,         // instructions per frame, by driver version
  code,         // the report of a GPU's compiler, exact by driver version
  memory,       // bytes allocated on the device, exact
  timing,       // reported; affects the verdict only on request
  correlation,  // the cost on one device as a function of the cost on another
  accuracy,     // orders of convergence and error against run time
  stress        // scores of hostile scenes
};
[[nodiscard]] std::string_view name_of(Check check);
[[nodiscard]] Check check(std::string_view name);  // throws InputError

using Checks = std::set<Check>;
[[nodiscard]] Checks every_check();
// "image,counters"; empty for no checks. Throws InputError for an unknown name.
[[nodiscard]] std::string text_of(const Checks& checks);
[[nodiscard]] Checks checks_of(std::string_view text);

}  // namespace triptych::record
