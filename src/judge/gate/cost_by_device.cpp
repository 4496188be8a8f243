#include "judge/gate/cost_by_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/statistics.hpp"
#include "judge/baselines/frame_change.hpp"
#include "judge/correlation/line.hpp"

namespace triptych::judge {
namespace {

// Returns nullopt if neither device code nor the driver was counted.
std::optional<FrameCost> frame_cost(const record::Counts& counts) {
  const FrameCost cost{count_of(counts, "device_code").value_or(0),
                       count_of(counts, "driver").value_or(0)};
  return cost.sum() > 0 ? std::optional(cost) : std::nullopt;
}

// Returns whether the record was measured itself, not copied from another configuration that does
// the same work. Copies are left out, because otherwise the same frames would be counted several
// times.
bool has_own_measurement(const record::Record& record) {
  return record.same_as.empty();
}

std::optional<FrameCost> stored_cost(const DriverCost* stored, const record::Record& record) {
  if (stored == nullptr || stored->counted_by != record.counted_by) return std::nullopt;
  const auto found = stored->configurations.find(record.configuration);
  return found == stored->configurations.end() ? std::nullopt : frame_cost(found->second.frame);
}

DeviceCost measured_cost(const record::Device& device, const CorrelationInput& input) {
  DeviceCost result{device.id, device.id, {}, true, {}};
  const auto found = input.stored.find(device.statistics_key());
  const DriverCost* stored = found == input.stored.end() ? nullptr : &found->second;
  for (const record::Record* record : input.records) {
    if (record->device != device.id || !has_own_measurement(*record)) continue;
    const auto now = frame_cost(record->cost);
    if (!now) continue;
    result.counted_by = record->counted_by;
    result.configurations[record->configuration] = {record, *now, stored_cost(stored, *record)};
  }
  return result;
}

DeviceCost stored_cost_of_driver(const DriverCost& stored) {
  DeviceCost result{stored.device,
                    fmt::format("{} ({})", stored.device, stored.driver_version),
                    stored.counted_by,
                    false,
                    {}};
  for (const auto& [configuration, cost] : stored.configurations) {
    const auto frame = frame_cost(cost.frame);
    if (frame) result.configurations[configuration] = {nullptr, *frame, *frame};
  }
  return result;
}

// Returns the logarithm of the median time by the given clock.
std::optional<double> log_median(const record::Record& record, std::string_view clock) {
  const std::vector<double>& times = record.time_ns_by(clock);
  return times.empty() ? std::nullopt : std::optional(std::log(estimation::median(times)));
}

using ByConfiguration = std::map<std::string, const record::Record*>;

CorrelationPair pair_by_time(const std::string& a, const ByConfiguration& of_a,
                             const std::string& b, const ByConfiguration& of_b) {
  CorrelationPair pair{.device_a = a, .device_b = b, .signal = "time"};
  for (const auto& [configuration, record] : of_a) {
    const auto other = of_b.find(configuration);
    if (other == of_b.end()) continue;
    const bool same_clock = record->clock() == other->second->clock();
    const std::string_view clock = same_clock ? record->clock() : "wall";
    const auto x = log_median(*record, clock);
    const auto y = log_median(*other->second, clock);
    if (x && y) pair.points.push_back({configuration, *x, *y});
  }
  fit_line(pair);
  return pair;
}

}  // namespace

bool DeviceCost::accepted() const {
  return std::ranges::any_of(configurations,
                             [](const auto& each) { return each.second.stored.has_value(); });
}

std::vector<DeviceCost> cost_by_device(const CorrelationInput& input) {
  std::vector<DeviceCost> result;
  std::set<std::string> measured_drivers;
  for (const auto& [id, device] : input.devices) {
    DeviceCost cost = measured_cost(device, input);
    if (cost.configurations.empty()) continue;
    measured_drivers.insert(device.statistics_key());
    result.push_back(std::move(cost));
  }
  for (const auto& [key, stored] : input.stored) {
    if (!measured_drivers.contains(key)) result.push_back(stored_cost_of_driver(stored));
  }
  return result;
}

Factors factors_of(const record::Record& record) {
  Factors factors = record.factors;
  factors["technique"] = record.technique;
  return factors;
}

CorrelationPair pair_of(const DeviceCost& a, const DeviceCost& b) {
  CorrelationPair pair{.device_a = a.name, .device_b = b.name, .signal = "cost"};
  pair.new_device = a.accepted() && !b.accepted();
  for (const auto& [configuration, of_b] : b.configurations) {
    const auto of_a = a.configurations.find(configuration);
    if (of_a == a.configurations.end()) continue;
    pair.points.push_back(
        {configuration, std::log(of_a->second.now.sum()), std::log(of_b.now.sum())});
  }
  fit_line(pair);
  return pair;
}

std::vector<CorrelationPair> pairs_by_time(const CorrelationInput& input) {
  std::map<std::string, ByConfiguration> devices;
  for (const record::Record* record : input.records) {
    if (!has_own_measurement(*record) || record->time_ns().empty()) continue;
    devices[record->device][record->configuration] = record;
  }
  std::vector<CorrelationPair> pairs;
  for (auto a = devices.begin(); a != devices.end(); ++a) {
    for (auto b = std::next(a); b != devices.end(); ++b) {
      pairs.push_back(pair_by_time(a->first, a->second, b->first, b->second));
    }
  }
  return pairs;
}

}  // namespace triptych::judge
