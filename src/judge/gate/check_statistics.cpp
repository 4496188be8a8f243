#include <fmt/format.h>

#include <iterator>
#include <set>
#include <string_view>

#include "judge/agreement.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

// The type of record::Device::statistics_calibration.
using Calibration = std::map<std::string, record::StatisticWorth>;

Finding check_exact(const RunView& view, const record::Record& record,
                    const record::Counts& stored) {
  const auto about = [&](Verdict verdict, Observation observation, AdviceWithCommand advice = {}) {
    observation.against = Against::baseline;
    return finding_about(record, Check::statistics, verdict, std::move(observation),
                         std::move(advice));
  };
  if (record.statistics.empty()) {
    return stored.empty() ? about(Verdict::skipped, {.cause = Cause::not_reported})
                          : about(Verdict::cannot_judge, {.cause = Cause::no_longer_reported},
                                  {Advice::run_again});
  }
  const Calibration& calibration = view.device(record).statistics_calibration;
  std::vector<Change> wrong;
  std::vector<std::string> unsteady;
  for (const auto& [name, value] : stored) {
    Change change{.name = name, .before = static_cast<double>(value)};
    const auto found = record.statistics.find(name);
    if (found == record.statistics.end()) {
      wrong.push_back(std::move(change));
    } else if (worth_of(calibration, name).is_unsteady()) {
      unsteady.push_back(name);
    } else if (found->second != value) {
      change.now = static_cast<double>(found->second);
      wrong.push_back(std::move(change));
    }
  }
  if (!wrong.empty()) {
    return about(Verdict::regression,
                 {.cause = Cause::values_changed, .changes = std::move(wrong)});
  }
  std::vector<std::string> unknown;
  for (const auto& [name, value] : record.statistics) {
    if (!stored.contains(name)) unknown.push_back(name);
  }
  if (!unknown.empty()) {
    return about(Verdict::cannot_judge, {.cause = Cause::unknown_values, .names = unknown},
                 view.accept_advice());
  }
  const auto values = static_cast<double>(stored.size() - unsteady.size());
  return about(Verdict::pass,
               {.cause = Cause::as_stored, .numbers = {{"values", values}}, .names = unsteady});
}

// The result of comparing the statistics of a device with the statistics of all stored drivers.
// This comparison is made if there are no baselines for the device's own driver version.
struct OtherDrivers {
  std::size_t configurations = 0;
  std::map<std::string, Change>
      differences;                  // portable statistics that differ from those of every driver
  std::set<std::string> differing;  // the configurations with such differences
  // How a driver counts a statistic, by (statistic, driver). Contains only statistics that the
  // driver does not count exactly. An empty driver stands for this device's own driver.
  std::map<std::pair<std::string, std::string>, std::string_view> not_compared;
  std::size_t stored = 0;    // number of configurations that are stored for at least one driver
  std::size_t compared = 0;  // number of values that were compared
};

void compare_statistic(const RunView& view, const record::Record& record, const std::string& name,
                       const std::map<std::string, record::Counts>& stored, OtherDrivers& result) {
  const auto own = record.statistics.find(name);
  if (own == record.statistics.end()) return;
  const auto own_worth = worth_of(view.device(record).statistics_calibration, name);
  if (!own_worth.is_exact()) {
    result.not_compared[{name, ""}] = name_of(own_worth.worth);
    return;
  }
  Change change{.name = name, .now = static_cast<double>(own->second)};
  bool agrees = false;
  for (const auto& [driver, counts] : stored) {
    const auto other = counts.find(name);
    if (other == counts.end()) continue;
    const auto stored_worth = worth_of(view.baselines.statistics_calibration(driver), name);
    if (!stored_worth.is_exact()) {
      result.not_compared[{name, driver}] = name_of(stored_worth.worth);
      continue;
    }
    agrees = agrees || other->second == own->second;
    change.accepted.emplace(driver, static_cast<double>(other->second));
  }
  if (change.accepted.empty()) return;
  ++result.compared;
  if (agrees) return;
  result.differences.emplace(name, std::move(change));
  result.differing.insert(record.configuration);
}

void compare_with_other_drivers(const RunView& view, const record::Record& record,
                                OtherDrivers& result) {
  ++result.configurations;
  const auto stored = view.baselines.statistics_of_all_drivers(record.configuration);
  if (stored.empty()) return;
  ++result.stored;
  for (const std::string_view name : portable_statistics) {
    compare_statistic(view, record, std::string(name), stored, result);
  }
}

Finding other_drivers_finding(const RunView& view, const record::Device& device,
                              const OtherDrivers& result) {
  Observation observation{
      .cause = Cause::other_driver_statistics,
      .against = Against::other_devices,
      .numbers = {{"configurations", static_cast<double>(result.configurations)},
                  {"stored", static_cast<double>(result.stored)},
                  {"compared", static_cast<double>(result.compared)},
                  {"differences", static_cast<double>(result.differing.size())}},
      .facts = {{"driver_version", device.driver_version}}};
  for (const auto& [name, change] : result.differences) observation.changes.push_back(change);
  for (const auto& [key, worth] : result.not_compared) {
    const auto& [name, driver] = key;
    observation.names.push_back(driver.empty() ? fmt::format("{}: {}", name, worth)
                                               : fmt::format("{} on {}: {}", name, driver, worth));
  }
  return finding_about(view, device, Check::statistics, Verdict::advisory, std::move(observation));
}

class StatisticsCheck {
 public:
  explicit StatisticsCheck(const RunView& view) : view_(view) {}

  void check_record(const record::Record& record) {
    const record::Device& device = view_.device(record);
    const auto stored = view_.baselines.statistics(device, record.configuration);
    if (record.untimed() && record.statistics.empty()) {
      findings_.push_back(
          finding_about(record, Check::statistics, Verdict::skipped, {.cause = Cause::untimed}));
    } else if (stored) {
      findings_.push_back(check_exact(view_, record, *stored));
    } else if (view_.baselines.has_statistics(device)) {
      not_stored_[record.device].push_back(record.configuration);
    } else if (record.statistics.empty()) {
      findings_.push_back(finding_about(record, Check::statistics, Verdict::skipped,
                                        {.cause = Cause::not_reported}));
    } else {
      compare_with_other_drivers(view_, record, other_drivers_[record.device]);
    }
  }

  std::vector<Finding> finish() && {
    for (const auto& [device, result] : other_drivers_) {
      findings_.push_back(other_drivers_finding(view_, view_.devices.at(device), result));
    }
    for (const auto& [device, configurations] : not_stored_) {
      findings_.push_back(finding_about(
          view_, view_.devices.at(device), Check::statistics, Verdict::cannot_judge,
          {.cause = Cause::not_stored, .names = configurations}, view_.accept_advice()));
    }
    return std::move(findings_);
  }

 private:
  const RunView& view_;
  std::vector<Finding> findings_;
  std::map<std::string, OtherDrivers> other_drivers_;  // by device
  // Configurations without stored statistics, by device, if the device has statistics for other
  // configurations.
  std::map<std::string, std::vector<std::string>> not_stored_;
};

}  // namespace

record::StatisticWorth worth_of(const Calibration& calibration, const std::string& statistic) {
  if (calibration.empty()) return {};
  const auto known = calibration.find(statistic);
  if (known != calibration.end()) return known->second;
  return {.worth = record::Worth::not_calibrated};
}

std::vector<Finding> check_statistics(const RunView& view) {
  StatisticsCheck check(view);
  for (const record::Record* record : view.measured) check.check_record(*record);
  return std::move(check).finish();
}

}  // namespace triptych::judge
