#include "report/screen/unmeasured.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "core/quoting.hpp"
#include "report/words/outcome.hpp"

namespace triptych::report {
namespace {

// Returns the reason without the properties that differ between configurations with the same cause:
// whether the configuration was tried, and what the worker printed last.
record::Reason common_part(record::Reason reason) {
  reason.not_tried = false;
  reason.shared_levels.clear();
  reason.last_output.clear();
  return reason;
}

std::string device_list(const std::set<std::string>& devices) {
  constexpr std::size_t most_listed = 3;
  if (devices.size() > most_listed) return fmt::format("{} devices", devices.size());
  return fmt::format("{}", fmt::join(devices, ", "));
}

}  // namespace

void Unmeasured::add(const record::Record& record) {
  if (record.outcome == record::Outcome::measured) return;
  const record::Reason reason = common_part(record.reason);
  auto group = std::ranges::find_if(groups_, [&](const Group& each) {
    return each.outcome == record.outcome && each.reason == reason;
  });
  if (group == groups_.end()) {
    groups_.push_back({.outcome = record.outcome, .reason = reason, .count = 0, .devices = {}});
    group = groups_.end() - 1;
  }
  ++group->count;
  group->devices.insert(record.device);
}

std::vector<std::string> Unmeasured::lines() const {
  std::vector<const Group*> sorted;
  for (const Group& group : groups_) sorted.push_back(&group);
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &Group::count);
  std::vector<std::string> lines;
  for (const Group* group : sorted) {
    if (lines.size() == most_lines) break;
    lines.push_back(core::printable(
        fmt::format("{} {} on {}: {}", group->count, record::name_of(group->outcome),
                    device_list(group->devices), words::text_of(group->reason))));
  }
  if (sorted.size() > lines.size()) {
    int count = 0;
    for (std::size_t i = lines.size(); i < sorted.size(); ++i) count += sorted[i]->count;
    lines.push_back(fmt::format(
        "{} more configurations were not measured for {} other reasons; `triptych report` lists "
        "them",
        count, sorted.size() - lines.size()));
  }
  return lines;
}

}  // namespace triptych::report
