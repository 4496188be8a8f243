#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "judge/agreement.hpp"
#include "judge/gate/counter_changes.hpp"
#include "judge/gate/open_counts.hpp"
#include "judge/gate/run_view.hpp"
#include "record/device_id.hpp"

namespace triptych::judge {
namespace {

// The accepted values of a counter on all devices: the smallest value, the largest value, and one
// value for each family of devices (drivers that share their implementation).
struct Range {
  std::uint64_t least = UINT64_MAX;
  std::uint64_t most = 0;
  std::map<std::string, std::uint64_t> families;  // family of devices → one of its values

  explicit Range(const std::map<std::string, std::uint64_t>& stored) {
    for (const auto& [device, value] : stored) {
      least = std::min(least, value);
      most = std::max(most, value);
      families.emplace(record::family_of(device), value);
    }
  }
  // Returns the number in [least, most] that is nearest to `value`.
  [[nodiscard]] std::uint64_t nearest(std::uint64_t value) const {
    return std::clamp(value, least, most);
  }
  [[nodiscard]] std::map<std::string, double> values() const {
    return {families.begin(), families.end()};
  }
};

double relative_difference(std::uint64_t value, std::uint64_t expected) {
  const double difference = static_cast<double>(value) - static_cast<double>(expected);
  return expected == 0 ? difference : difference / static_cast<double>(expected);
}

struct Differences {
  std::vector<Change> wrong;
  std::vector<std::string> unknown;
  double largest = 0;
};

void compare_with_own(const std::string& name, std::uint64_t stored, const record::Record& record,
                      Differences& out) {
  Change change{.name = name, .before = static_cast<double>(stored)};
  const auto found = record.counters.find(name);
  if (found != record.counters.end()) {
    if (found->second == stored) return;
    out.largest = std::max(out.largest, std::abs(relative_difference(found->second, stored)));
    change.now = static_cast<double>(found->second);
  }
  out.wrong.push_back(std::move(change));
}

// Compares a counter with the accepted values of other devices or driver versions. The record may
// lack the counter, because the counter may not apply to this device.
void compare_with_others(const std::string& name, const Range& range, const record::Record& record,
                         OpenCounts& open, Differences& out) {
  const auto found = record.counters.find(name);
  if (found == record.counters.end()) return;
  const std::uint64_t nearest = range.nearest(found->second);
  const double relative = relative_difference(found->second, nearest);
  out.largest = std::max(out.largest, std::abs(relative));
  const double excess = relative * static_cast<double>(nearest);
  if (std::abs(relative) <= counters_across_devices || std::abs(excess) <= open.of(name)) return;
  out.wrong.push_back({.name = name,
                       .before = static_cast<double>(nearest),
                       .now = static_cast<double>(found->second),
                       .accepted = range.values(),
                       .allowed = open.of(name)});
}

// Compares one counter. On a driver version that was accepted, the value must equal the accepted
// value. On every driver version, a counter that was accepted on this device must not be missing.
void compare_counter(const std::string& name, const std::map<std::string, std::uint64_t>& stored,
                     const record::Record& record, bool known_driver, OpenCounts& open,
                     Differences& out) {
  const auto own = stored.find(record.device);
  const bool exact = known_driver || !record.counters.contains(name);
  if (own != stored.end() && exact) return compare_with_own(name, own->second, record, out);
  compare_with_others(name, Range(stored), record, open, out);
}

Finding check_record(const RunView& view, const record::Record& record,
                     const StoredCounters& stored) {
  const auto about = [&](Verdict verdict, Observation observation, AdviceWithCommand advice = {}) {
    return finding_about(record, Check::counters, verdict, std::move(observation),
                         std::move(advice));
  };
  if (record.counters.empty()) {
    return stored.empty()
               ? about(Verdict::skipped, {.cause = Cause::not_reported})
               : about(Verdict::cannot_judge,
                       {.cause = Cause::no_longer_reported, .against = Against::baseline},
                       {Advice::run_again});
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
  const Against against = known_driver ? Against::baseline : Against::other_devices;
  Finding finding =
      !differences.wrong.empty()
          ? about(Verdict::regression, {.cause = Cause::values_changed,
                                        .against = against,
                                        .changes = std::move(differences.wrong)})
      : !differences.unknown.empty()
          ? about(Verdict::cannot_judge,
                  {.cause = Cause::unknown_values, .names = std::move(differences.unknown)},
                  view.accept_advice())
          : about(Verdict::pass,
                  {.cause = Cause::as_stored,
                   .against = against,
                   .numbers = {{"values", static_cast<double>(record.counters.size())}}});
  set_number(finding, "relative_difference", differences.largest);
  return finding;
}

}  // namespace

std::vector<Change> counter_changes(const record::Record& record,
                                    const StoredCounters& other_devices,
                                    const FindOpenCounts& open_counts) {
  Differences differences;
  OpenCounts open(record, open_counts);
  for (const auto& [name, values] : other_devices) {
    compare_with_others(name, Range(values), record, open, differences);
  }
  return differences.wrong;
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
    // For a new device, a configuration without stored counters is skipped, because no accepted
    // device could draw it, so there is nothing to compare with.
    const record::Device& info = view.devices.at(device);
    const bool known = !view.baselines.present() || view.knows_driver(info);
    findings.push_back(
        finding_about(view, info, Check::counters, known ? Verdict::cannot_judge : Verdict::skipped,
                      {.cause = Cause::not_stored, .names = configurations}, view.accept_advice()));
  }
  return findings;
}

}  // namespace triptych::judge
