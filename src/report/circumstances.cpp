#include "report/circumstances.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "report/words/outcome.hpp"

namespace triptych::report {

std::vector<std::string> circumstances(std::span<const judge::GateResult* const> results) {
  std::map<std::string, std::size_t> injected;
  std::set<std::string> unusable;
  std::set<std::string> programs;
  for (const judge::GateResult* result : results) {
    for (const auto& [fault, records] : result->injected) injected[fault] += records;
    for (const record::Unusable& each : result->unusable) {
      unusable.insert(fmt::format("not usable here: {}: {}", each.what,
                                  each.ended ? words::text_of(*each.ended) : each.reason));
    }
    if (!result->measured_by.empty()) programs.insert(result->measured_by);
  }
  std::vector<std::string> lines;
  for (const auto& [fault, records] : injected) {
    lines.push_back(fmt::format("injected fault {} in {} record{}: this verdict is a test of Triptych",
                                fault, records, records == 1 ? "" : "s"));
  }
  for (const std::string& program : programs) {
    lines.push_back(fmt::format("measured by another build of Triptych: {}", program));
  }
  lines.insert(lines.end(), unusable.begin(), unusable.end());
  return lines;
}

}  // namespace triptych::report
