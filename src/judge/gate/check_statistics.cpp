#include <fmt/format.h>

#include <string_view>

#include "judge/gate/run_view.hpp"
#include "judge/images/agreement.hpp"

namespace triptych::judge {
namespace {

using Dialect = std::map<std::string, std::string>;  // record::Device::statistics_dialect

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
  std::vector<std::string> wrong;
  for (const auto& [name, value] : stored) {
    const auto found = record.statistics.find(name);
    if (found == record.statistics.end()) {
      wrong.push_back(fmt::format("{} is missing, stored {}", name, value));
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
  return about(Verdict::pass, fmt::format("{} statistics as stored", stored.size()));
}

struct Elsewhere {
  std::vector<std::string> differences;   // which portable values no stored driver has
  std::vector<std::string> not_compared;  // with the reason
  int compared = 0;
};

// "input_assembly_vertices 3, but 6 on gl-llvmpipe-egl-…"; "geometry_primitives (here differs: …)".
void compare_elsewhere(const RunView& view, const record::Record& record, const std::string& name,
                       const std::map<std::string, record::Counts>& stored, Elsewhere& result) {
  const auto own = record.statistics.find(name);
  if (own == record.statistics.end()) return;
  const std::string here = statistic_reservation(view.device(record).statistics_dialect, name);
  if (!here.empty()) {
    result.not_compared.push_back(fmt::format("{} (here {})", name, here));
    return;
  }
  std::vector<std::string> others;
  bool agrees = false;
  for (const auto& [driver, counts] : stored) {
    const auto other = counts.find(name);
    if (other == counts.end()) continue;
    const std::string there =
        statistic_reservation(view.baselines.statistics_dialect(driver), name);
    if (!there.empty()) {
      result.not_compared.push_back(fmt::format("{} (on {} {})", name, driver, there));
      continue;
    }
    agrees = agrees || other->second == own->second;
    others.push_back(fmt::format("{} on {}", other->second, driver));
  }
  if (!others.empty()) ++result.compared;
  if (!agrees && !others.empty()) {
    result.differences.push_back(
        fmt::format("{} {}, but {}", name, own->second, fmt::join(others, ", ")));
  }
}

Finding check_elsewhere(const RunView& view, const record::Record& record) {
  if (record.statistics.empty()) {
    return finding_about(record, Check::statistics, Verdict::skipped,
                         "the device tells no pipeline statistics");
  }
  const auto stored = view.baselines.statistics_of_all_drivers(record.configuration);
  Elsewhere result;
  for (const std::string_view name : portable_statistics) {
    if (stored.empty()) break;
    compare_elsewhere(view, record, std::string(name), stored, result);
  }
  std::string message = "nothing stored for this driver version; ";
  if (stored.empty()) {
    message += "nor for any other";
  } else if (!result.differences.empty()) {
    message +=
        fmt::format("differs from every stored driver: {}", fmt::join(result.differences, "; "));
  } else if (result.compared == 0 && !result.not_compared.empty()) {
    message += "no number of it can be held against the stored ones";
  } else {
    message += "what drivers must agree on agrees with the stored ones";
  }
  if (!result.not_compared.empty()) {
    message += fmt::format("; not compared: {}", fmt::join(result.not_compared, "; "));
  }
  Finding finding = finding_about(record, Check::statistics, Verdict::advisory, std::move(message));
  set_number(finding, "differences", static_cast<double>(result.differences.size()));
  return finding;
}

Finding check_record(const RunView& view, const record::Record& record) {
  if (record.untimed()) {
    return finding_about(record, Check::statistics, Verdict::skipped,
                         "pipeline statistics were not read: the run was untimed");
  }
  const record::Device& device = view.device(record);
  if (!view.baselines.has_statistics(device)) return check_elsewhere(view, record);
  const auto stored = view.baselines.statistics(device, record.configuration);
  if (stored) return check_exact(view, record, *stored);
  return finding_about(
      record, Check::statistics, Verdict::cannot_judge,
      "no stored statistics for this configuration; accept them: " + view.accept_command());
}

}  // namespace

std::string statistic_reservation(const Dialect& dialect, const std::string& statistic) {
  if (dialect.empty()) return {};
  const auto verdict = dialect.find(statistic);
  if (verdict == dialect.end()) return "not calibrated";
  return verdict->second == "exact" ? std::string() : verdict->second;
}

std::vector<Finding> check_statistics(const RunView& view) {
  std::vector<Finding> findings;
  for (const record::Record* record : view.measured) {
    findings.push_back(check_record(view, *record));
  }
  return findings;
}

}  // namespace triptych::judge
