#include <fmt/format.h>

#include <iterator>
#include <set>
#include <string_view>

#include "judge/agreement.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

using Calibration = std::map<std::string, std::string>;  // record::Device::statistics_calibration

Finding check_exact(const RunView& view, const record::Record& record,
                    const record::Counts& stored) {
  const auto about = [&](Verdict verdict, std::string message) {
    return finding_about(record, Check::statistics, verdict, std::move(message));
  };
  if (record.statistics.empty()) {
    return stored.empty()
               ? about(Verdict::skipped, "the device tells no pipeline statistics")
               : about(Verdict::cannot_judge,
                       "no statistics were read, though this driver told them before; run "
                       "the plan again with statistics frames");
  }
  const Calibration& calibration = view.device(record).statistics_calibration;
  std::vector<std::string> wrong;
  std::vector<std::string> unsteady;
  for (const auto& [name, value] : stored) {
    const auto found = record.statistics.find(name);
    if (found == record.statistics.end()) {
      wrong.push_back(fmt::format("{} is missing, stored {}", name, value));
    } else if (is_unsteady(statistic_reservation(calibration, name))) {
      unsteady.push_back(name);
    } else if (found->second != value) {
      wrong.push_back(fmt::format("{} {} → {}", name, value, found->second));
    }
  }
  if (!wrong.empty()) {
    return about(Verdict::regression,
                 fmt::format("on the same driver version: {}", fmt::join(wrong, "; ")));
  }
  std::vector<std::string> unknown;
  for (const auto& [name, value] : record.statistics) {
    if (!stored.contains(name)) unknown.push_back(name);
  }
  if (!unknown.empty()) {
    return about(Verdict::cannot_judge,
                 fmt::format("statistics without a stored value: {}; accept them: {}",
                             fmt::join(unknown, ", "), view.accept_command()));
  }
  std::string message = fmt::format("{} statistics as stored", stored.size() - unsteady.size());
  if (!unsteady.empty()) {
    message += fmt::format("; unsteady, so not compared: {}", fmt::join(unsteady, ", "));
  }
  return about(Verdict::pass, std::move(message));
}

// Of a device whose driver version is new here, over all that it measured.
struct Elsewhere {
  std::vector<std::string> configurations;
  std::set<std::string> differences;   // which portable values no stored driver has
  std::set<std::string> differing;     // in which configurations
  std::set<std::string> not_compared;  // with the reason
  std::size_t stored = 0;              // configurations that some driver has
  std::size_t compared = 0;            // values
};

// "input_assembly_vertices 3, but 6 on gl-llvmpipe-egl-…"; "geometry_primitives (here differs: …)".
void compare_elsewhere(const RunView& view, const record::Record& record, const std::string& name,
                       const std::map<std::string, record::Counts>& stored, Elsewhere& result) {
  const auto own = record.statistics.find(name);
  if (own == record.statistics.end()) return;
  const std::string here = statistic_reservation(view.device(record).statistics_calibration, name);
  if (!here.empty()) {
    result.not_compared.insert(fmt::format("{} (here {})", name, here));
    return;
  }
  std::vector<std::string> others;
  bool agrees = false;
  for (const auto& [driver, counts] : stored) {
    const auto other = counts.find(name);
    if (other == counts.end()) continue;
    const std::string there =
        statistic_reservation(view.baselines.statistics_calibration(driver), name);
    if (!there.empty()) {
      result.not_compared.insert(fmt::format("{} (on {} {})", name, driver, there));
      continue;
    }
    agrees = agrees || other->second == own->second;
    others.push_back(fmt::format("{} on {}", other->second, driver));
  }
  if (!others.empty()) ++result.compared;
  if (!agrees && !others.empty()) {
    result.differences.insert(
        fmt::format("{} {}, but {}", name, own->second, fmt::join(others, ", ")));
    result.differing.insert(record.configuration);
  }
}

void look_elsewhere(const RunView& view, const record::Record& record, Elsewhere& result) {
  result.configurations.push_back(record.configuration);
  const auto stored = view.baselines.statistics_of_all_drivers(record.configuration);
  if (stored.empty()) return;
  ++result.stored;
  for (const std::string_view name : portable_statistics) {
    compare_elsewhere(view, record, std::string(name), stored, result);
  }
}

Finding tell_elsewhere(const RunView& view, const record::Device& device, const Elsewhere& result) {
  constexpr std::size_t named = 3;
  std::string message =
      fmt::format("nothing stored for this driver version ({}), {} configurations; ",
                  device.driver_version, result.configurations.size());
  if (result.stored == 0) {
    message += "nor for any other";
  } else if (!result.differences.empty()) {
    const std::size_t n = std::min(named, result.differences.size());
    const std::vector<std::string> first(
        result.differences.begin(),
        std::next(result.differences.begin(), static_cast<std::ptrdiff_t>(n)));
    message += fmt::format("in {} of them it differs from every stored driver: {}{}",
                           result.differing.size(), fmt::join(first, "; "),
                           result.differences.size() > n ? "; …" : "");
  } else if (result.compared == 0 && !result.not_compared.empty()) {
    message += "no number of it can be held against the stored ones";
  } else {
    message += "what drivers must agree on agrees with the stored ones";
  }
  if (!result.not_compared.empty()) {
    message += fmt::format("; not compared: {}", fmt::join(result.not_compared, "; "));
  }
  Finding finding =
      finding_about(view, device, Check::statistics, Verdict::advisory, std::move(message));
  set_number(finding, "differences", static_cast<double>(result.differing.size()));
  return finding;
}

class StatisticsCheck {
 public:
  explicit StatisticsCheck(const RunView& view) : view_(view) {}

  void look_at(const record::Record& record) {
    const record::Device& device = view_.device(record);
    const auto stored = view_.baselines.statistics(device, record.configuration);
    if (record.untimed() && record.statistics.empty()) {
      findings_.push_back(finding_about(record, Check::statistics, Verdict::skipped,
                                        "pipeline statistics were not read: the run was untimed"));
    } else if (stored) {
      findings_.push_back(check_exact(view_, record, *stored));
    } else if (view_.baselines.has_statistics(device)) {
      not_stored_[record.device].push_back(record.configuration);
    } else if (record.statistics.empty()) {
      findings_.push_back(finding_about(record, Check::statistics, Verdict::skipped,
                                        "the device tells no pipeline statistics"));
    } else {
      look_elsewhere(view_, record, elsewhere_[record.device]);
    }
  }

  std::vector<Finding> finish() && {
    for (const auto& [device, result] : elsewhere_) {
      findings_.push_back(tell_elsewhere(view_, view_.devices.at(device), result));
    }
    for (const auto& [device, configurations] : not_stored_) {
      findings_.push_back(
          finding_about(view_, view_.devices.at(device), Check::statistics, Verdict::cannot_judge,
                        fmt::format("no stored statistics for {}; accept them: {}",
                                    examples_of(configurations), view_.accept_command())));
    }
    return std::move(findings_);
  }

 private:
  const RunView& view_;
  std::vector<Finding> findings_;
  std::map<std::string, Elsewhere> elsewhere_;                  // by device
  std::map<std::string, std::vector<std::string>> not_stored_;  // beside others of the device
};

}  // namespace

std::string statistic_reservation(const Calibration& calibration, const std::string& statistic) {
  if (calibration.empty()) return {};
  const auto verdict = calibration.find(statistic);
  if (verdict == calibration.end()) return "not calibrated";
  return verdict->second == "exact" ? std::string() : verdict->second;
}

std::vector<Finding> check_statistics(const RunView& view) {
  StatisticsCheck check(view);
  for (const record::Record* record : view.measured) check.look_at(*record);
  return std::move(check).finish();
}

}  // namespace triptych::judge
