#include "report/circumstances.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "report/words/outcome.hpp"

namespace triptych::report {

namespace {

// Reports results that were skipped because data files are missing. Names only one of the files,
// because the others are usually in the same folder.
std::string absent_data(std::span<const judge::GateResult* const> results) {
  std::set<std::string> files;
  std::set<std::tuple<std::string, std::string, std::string>> missing;
  bool excused = true;
  for (const judge::GateResult* result : results) {
    for (const judge::Finding& finding : result->findings) {
      if (!lacks_data(finding.outcome, finding.reason)) continue;
      files.insert(finding.reason.subject);
      missing.emplace(result->plan, finding.device, finding.configuration);
      excused = excused && result->data_excused;
    }
  }
  if (files.empty()) return {};
  return fmt::format(
      "missing data files: {} ({}{}), so {} results were skipped; docs/data.md lists where to "
      "download the files{}",
      files.size(), *files.begin(), files.size() > 1 ? ", …" : "", missing.size(),
      excused ? "" : "; if this machine does not need them, use --without-data");
}

}  // namespace

bool lacks_data(record::Outcome outcome, const record::Reason& reason) {
  return outcome == record::Outcome::skipped && reason.cause == record::Cause::not_supported &&
         !reason.subject.empty();
}

std::vector<std::string> circumstances(std::span<const judge::GateResult* const> results) {
  std::set<std::string> injected;
  std::size_t injected_records = 0;
  // Unusable loaders and drivers, by reason.
  std::map<std::string, std::set<std::string>> unusable;
  std::set<std::string> programs;
  std::set<std::string> days;
  for (const judge::GateResult* result : results) {
    for (const auto& [fault, records] : result->injected) {
      injected.insert(fault);
      injected_records += records;
    }
    for (const record::Unusable& each : result->unusable) {
      unusable[each.ended ? words::text_of(*each.ended) : each.reason].insert(each.what);
    }
    if (!result->measured_by.empty()) programs.insert(result->measured_by);
    if (!result->old_run_date.empty()) days.insert(result->old_run_date);
  }
  std::vector<std::string> lines;
  if (!injected.empty()) {
    lines.push_back(fmt::format(
        "this verdict tests only Triptych, because {} record{} injected faults ({})",
        injected_records, injected_records == 1 ? " has" : "s have", fmt::join(injected, ", ")));
  }
  for (const std::string& program : programs) {
    lines.push_back(fmt::format("measured by another build of Triptych: {}", program));
  }
  if (!days.empty()) {
    lines.push_back(
        fmt::format("the measurements are from {}, because the store has no newer run of the plan",
                    fmt::join(days, " and ")));
  }
  for (const auto& [reason, what] : unusable) {
    lines.push_back(fmt::format("unusable on this machine: {}: {}", fmt::join(what, ", "), reason));
  }
  if (std::string data = absent_data(results); !data.empty()) lines.push_back(std::move(data));
  return lines;
}

}  // namespace triptych::report
