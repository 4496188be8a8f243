#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "judge/gate/run_view.hpp"
#include "judge/images/agreement.hpp"

namespace triptych::judge {
namespace {

struct Expected {
  std::uint64_t value = 0;
  bool own = false;  // stored from this very device: exact
};

// The device's own value, else the median (a stored value, the lower of two) of the others'.
Expected expected_on(const std::map<std::string, std::uint64_t>& stored,
                     const std::string& device) {
  const auto own = stored.find(device);
  if (own != stored.end()) return {own->second, true};
  std::vector<std::uint64_t> values;
  for (const auto& [other, value] : stored) values.push_back(value);
  std::ranges::sort(values);
  return {values[(values.size() - 1) / 2], false};
}

double relative_difference(std::uint64_t value, std::uint64_t expected) {
  const double difference = static_cast<double>(value) - static_cast<double>(expected);
  return expected == 0 ? difference : difference / static_cast<double>(expected);
}

struct Differences {
  std::vector<std::string> wrong;
  std::vector<std::string> unknown;
  double largest = 0;
};

void compare_counter(const std::string& name, const std::map<std::string, std::uint64_t>& stored,
                     const record::Record& record, Differences& out) {
  const Expected expected = expected_on(stored, record.device);
  const auto found = record.counters.find(name);
  if (found == record.counters.end()) {
    // Another device's counter may have no meaning here; one that this device told before is lost.
    if (expected.own)
      out.wrong.push_back(fmt::format("{} is missing, stored {}", name, expected.value));
    return;
  }
  const double relative = relative_difference(found->second, expected.value);
  const bool same = expected.own ? found->second == expected.value
                                 : std::abs(relative) <= counters_across_devices;
  out.largest = std::max(out.largest, std::abs(relative));
  if (same) return;
  out.wrong.push_back(fmt::format("{} {} → {} ({:+.4g} %{})", name, expected.value, found->second,
                                  100 * relative,
                                  expected.own ? "" : ", against the other devices' median"));
}

Finding check_record(const RunView& view, const record::Record& record) {
  const auto about = [&](Verdict verdict, std::string message) {
    return finding_about(record, Check::counters, verdict, std::move(message));
  };
  const auto stored = view.baselines.counters(record.configuration);
  if (!stored) {
    return about(Verdict::cannot_judge, "no stored counters for this configuration; accept them: " +
                                            view.accept_command());
  }
  if (record.counters.empty()) {
    return stored->empty() ? about(Verdict::skipped, "this technique counts nothing")
                           : about(Verdict::cannot_judge,
                                   "nothing was counted; run the plan again with counting frames");
  }
  Differences differences;
  for (const auto& [name, values] : *stored) compare_counter(name, values, record, differences);
  for (const auto& [name, value] : record.counters) {
    if (!stored->contains(name)) differences.unknown.push_back(name);
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

std::vector<Finding> check_counters(const RunView& view) {
  std::vector<Finding> findings;
  for (const record::Record* record : view.measured) {
    findings.push_back(check_record(view, *record));
  }
  return findings;
}

}  // namespace triptych::judge
