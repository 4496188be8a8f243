#include "judge/baselines/work.hpp"

#include <cmath>

namespace triptych::judge {
std::optional<WorkChange> work_change(
    const record::Counts& now,
    const std::function<std::optional<double>(const std::string&)>& before) {
  for (const std::string_view unit : work_units) {
    const auto count = now.find(std::string(unit));
    if (count == now.end() || count->second == 0) continue;
    const auto old_count = before(count->first);
    if (!old_count || !(*old_count > 0)) continue;
    return WorkChange{.log_ratio = std::log(static_cast<double>(count->second) / *old_count),
                      .unit = count->first};
  }
  return std::nullopt;
}

std::optional<WorkChange> work_change(const record::Counts& now, const record::Counts& before) {
  return work_change(now, [&](const std::string& unit) -> std::optional<double> {
    const auto count = before.find(unit);
    if (count == before.end()) return std::nullopt;
    return static_cast<double>(count->second);
  });
}

std::optional<WorkChange> work_change(const record::Counts& now, const Baselines& baselines,
                                      const std::string& configuration, const std::string& device) {
  const auto counters = baselines.counters(configuration);
  return work_change(now, [&](const std::string& unit) -> std::optional<double> {
    if (!counters) return std::nullopt;
    const auto counter = counters->find(unit);
    if (counter == counters->end()) return std::nullopt;
    const auto value = counter->second.find(device);
    if (value == counter->second.end()) return std::nullopt;
    return static_cast<double>(value->second);
  });
}

}  // namespace triptych::judge
