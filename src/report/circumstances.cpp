#include "report/circumstances.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <set>

#include "report/words/outcome.hpp"

namespace triptych::report {

std::vector<std::string> circumstances(std::span<const judge::GateResult* const> results) {
  std::set<std::string> injected;
  std::size_t injected_records = 0;
  std::map<std::string, std::set<std::string>> unusable;  // by reason
  std::set<std::string> programs;
  for (const judge::GateResult* result : results) {
    for (const auto& [fault, records] : result->injected) {
      injected.insert(fault);
      injected_records += records;
    }
    for (const record::Unusable& each : result->unusable) {
      unusable[each.ended ? words::text_of(*each.ended) : each.reason].insert(each.what);
    }
    if (!result->measured_by.empty()) programs.insert(result->measured_by);
  }
  std::vector<std::string> lines;
  if (!injected.empty()) {
    lines.push_back(fmt::format(
        "this verdict is a test of Triptych: {} record{} injected faults ({})", injected_records,
        injected_records == 1 ? " has" : "s have", fmt::join(injected, ", ")));
  }
  for (const std::string& program : programs) {
    lines.push_back(fmt::format("measured by another build of Triptych: {}", program));
  }
  for (const auto& [reason, what] : unusable) {
    lines.push_back(fmt::format("not usable here: {}: {}", fmt::join(what, ", "), reason));
  }
  return lines;
}

}  // namespace triptych::report
