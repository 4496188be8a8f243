#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "judge/agreement.hpp"
#include "judge/gate/counters_fault.hpp"
#include "judge/gate/open_counts.hpp"
#include "judge/gate/run_view.hpp"
#include "record/device_id.hpp"

namespace triptych::judge {
namespace {

// What was accepted on other devices: the least and the most, and of whom. A family has one vote.
struct Range {
  std::uint64_t least = UINT64_MAX;
  std::uint64_t most = 0;
  std::map<std::string, std::uint64_t> families;  // each with one of its values

  explicit Range(const std::map<std::string, std::uint64_t>& stored) {
    for (const auto& [device, value] : stored) {
      least = std::min(least, value);
      most = std::max(most, value);
      families.emplace(record::family_of(device), value);
    }
  }
  // The end of the range that is nearer.
  [[nodiscard]] std::uint64_t nearest(std::uint64_t value) const {
    return std::clamp(value, least, most);
  }
  [[nodiscard]] std::string text() const {
    std::vector<std::string> parts;
    for (const auto& [family, value] : families) {
      parts.push_back(fmt::format("{} on {}", value, family));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
  }
};

double relative_difference(std::uint64_t value, std::uint64_t expected) {
  const double difference = static_cast<double>(value) - static_cast<double>(expected);
  return expected == 0 ? difference : difference / static_cast<double>(expected);
}

struct Differences {
  std::vector<std::string> wrong;
  std::vector<std::string> unknown;
  double largest = 0;
};

void compare_own(const std::string& name, std::uint64_t stored, const record::Record& record,
                 Differences& out) {
  const auto found = record.counters.find(name);
  if (found == record.counters.end()) {
    out.wrong.push_back(fmt::format("{} is missing, stored {}", name, stored));
    return;
  }
  if (found->second == stored) return;
  const double relative = relative_difference(found->second, stored);
  out.largest = std::max(out.largest, std::abs(relative));
  out.wrong.push_back(
      fmt::format("{} {} → {} ({:+.4g} %)", name, stored, found->second, 100 * relative));
}

// Of another device or driver version. A counter may have no meaning here: it need not be there.
void compare_with_others(const std::string& name, const Range& range, const record::Record& record,
                         OpenCounts& open, Differences& out) {
  const auto found = record.counters.find(name);
  if (found == record.counters.end()) return;
  const double relative = relative_difference(found->second, range.nearest(found->second));
  out.largest = std::max(out.largest, std::abs(relative));
  const double excess = relative * static_cast<double>(range.nearest(found->second));
  if (std::abs(relative) <= counters_across_devices || std::abs(excess) <= open.of(name)) return;
  out.wrong.push_back(fmt::format("{} {} ({:+.4g} % beyond what was accepted: {}; {:.0f} are open)",
                                  name, found->second, 100 * relative, range.text(),
                                  open.of(name)));
}

// Exact is what the same driver version counted before, and that a counter is told at all.
void compare_counter(const std::string& name, const std::map<std::string, std::uint64_t>& stored,
                     const record::Record& record, bool known_driver, OpenCounts& open,
                     Differences& out) {
  const auto own = stored.find(record.device);
  const bool exact = known_driver || !record.counters.contains(name);
  if (own != stored.end() && exact) return compare_own(name, own->second, record, out);
  compare_with_others(name, Range(stored), record, open, out);
}

Finding check_record(const RunView& view, const record::Record& record,
                     const StoredCounters& stored) {
  const auto about = [&](Verdict verdict, std::string message) {
    return finding_about(record, Check::counters, verdict, std::move(message));
  };
  if (record.counters.empty()) {
    return stored.empty() ? about(Verdict::skipped, "this technique counts nothing")
                          : about(Verdict::cannot_judge,
                                  "nothing was counted; run the plan again with counting frames");
  }
  Differences differences;
  const bool known_driver = view.knows_driver(view.device(record));
  OpenCounts open(record, view.request.open_counts);
  for (const auto& [name, values] : stored) {
    compare_counter(name, values, record, known_driver, open, differences);
  }
  for (const auto& [name, value] : record.counters) {
    if (!stored.contains(name)) differences.unknown.push_back(name);
  }
  Finding finding =
      about(Verdict::pass, fmt::format("{} counters as stored", record.counters.size()));
  if (!differences.wrong.empty()) {
    finding = about(Verdict::regression, fmt::format("{}", fmt::join(differences.wrong, "; ")));
  } else if (!differences.unknown.empty()) {
    finding = about(Verdict::cannot_judge,
                    fmt::format("counters without a stored value: {}; accept them: {}",
                                fmt::join(differences.unknown, ", "), view.accept_command()));
  }
  set_number(finding, "relative_difference", differences.largest);
  return finding;
}

}  // namespace

std::string counters_fault(const record::Record& record, const StoredCounters& of_others,
                           const FindOpenCounts& open_counts) {
  Differences differences;
  OpenCounts open(record, open_counts);
  for (const auto& [name, values] : of_others) {
    compare_with_others(name, Range(values), record, open, differences);
  }
  return fmt::format("{}", fmt::join(differences.wrong, "; "));
}

std::vector<Finding> check_counters(const RunView& view) {
  std::vector<Finding> findings;
  std::map<std::string, std::vector<std::string>> not_stored;  // by device
  for (const record::Record* record : view.measured) {
    const auto stored = view.baselines.counters(record->configuration);
    if (stored) {
      findings.push_back(check_record(view, *record, *stored));
    } else {
      not_stored[record->device].push_back(record->configuration);
    }
  }
  for (const auto& [device, configurations] : not_stored) {
    // What no accepted device could draw says nothing of one that was never accepted.
    const record::Device& info = view.devices.at(device);
    const bool known = !view.baselines.present() || view.knows_driver(info);
    findings.push_back(
        finding_about(view, info, Check::counters, known ? Verdict::cannot_judge : Verdict::skipped,
                      fmt::format("no stored counters for {}; accept them: {}",
                                  examples_of(configurations), view.accept_command())));
  }
  return findings;
}

}  // namespace triptych::judge
