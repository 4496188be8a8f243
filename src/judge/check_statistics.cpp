#include <fmt/format.h>

#include <array>
#include <string_view>

#include "judge/run_view.hpp"

namespace triptych::judge {
namespace {

// Vulkan and GL leave the rest of the statistics to the implementation.
constexpr std::array<std::string_view, 5> portable{
    "input_assembly_vertices", "input_assembly_primitives", "geometry_primitives",
    "tessellation_control_patches", "compute_invocations"};

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

// "input_assembly_vertices 3, 6 on gl-llvmpipe-egl-…": which portable values no stored driver has.
std::vector<std::string> portable_differences(const record::Counts& statistics,
                                              const std::map<std::string, record::Counts>& stored) {
  std::vector<std::string> differences;
  for (const std::string_view name : portable) {
    const auto own = statistics.find(std::string(name));
    if (own == statistics.end()) continue;
    std::vector<std::string> others;
    bool agrees = false;
    for (const auto& [driver, counts] : stored) {
      const auto other = counts.find(own->first);
      if (other == counts.end()) continue;
      agrees = agrees || other->second == own->second;
      others.push_back(fmt::format("{} on {}", other->second, driver));
    }
    if (!agrees && !others.empty()) {
      differences.push_back(
          fmt::format("{} {}, but {}", name, own->second, fmt::join(others, ", ")));
    }
  }
  return differences;
}

Finding check_elsewhere(const RunView& view, const record::Record& record) {
  if (record.statistics.empty()) {
    return finding_about(record, Check::statistics, Verdict::skipped,
                         "the device tells no pipeline statistics");
  }
  const auto stored = view.baselines.statistics_of_all_drivers(record.configuration);
  const auto differences = portable_differences(record.statistics, stored);
  std::string message = "nothing stored for this driver version; ";
  message += stored.empty()        ? "nor for any other"
             : differences.empty() ? "what drivers must agree on agrees with the stored ones"
                                   : fmt::format("differs from every stored driver: {}",
                                                 fmt::join(differences, "; "));
  Finding finding = finding_about(record, Check::statistics, Verdict::advisory, std::move(message));
  set_number(finding, "differences", static_cast<double>(differences.size()));
  return finding;
}

Finding check_record(const RunView& view, const record::Record& record) {
  const record::Device& device = view.device(record);
  if (!view.baselines.has_statistics(device)) return check_elsewhere(view, record);
  const auto stored = view.baselines.statistics(device, record.configuration);
  if (stored) return check_exact(view, record, *stored);
  return finding_about(
      record, Check::statistics, Verdict::cannot_judge,
      "no stored statistics for this configuration; accept them: " + view.accept_command());
}

}  // namespace

std::vector<Finding> check_statistics(const RunView& view) {
  std::vector<Finding> findings;
  for (const record::Record* record : view.measured) {
    findings.push_back(check_record(view, *record));
  }
  return findings;
}

}  // namespace triptych::judge
