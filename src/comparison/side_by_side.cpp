#include "comparison/side_by_side.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "judge/baselines/frame_change.hpp"

namespace triptych::comparison {
namespace {

using Value = double (*)(const record::Record&);  // returns 0 if the record has no value
using ByDevice = std::map<std::string, const record::Record*>;

// Counters that describe the work of a frame and have the same definition in all APIs.
constexpr std::array<const char*, 3> work_counters{"samples", "fragments", "primitives"};

double instructions_of(const record::Record& record) {
  return judge::frame_instructions(record.cost);
}

double median_time(const record::Record& record, std::string_view clock) {
  const auto summary = record::summarise(record.time_ns_by(clock));
  return summary ? summary->median : 0;
}
double device_time_of(const record::Record& record) {
  return median_time(record, "device");
}
double wall_time_of(const record::Record& record) {
  return median_time(record, "wall");
}

// Returns, for each technique, the configurations that were measured on at least two devices. Each
// configuration is a map from the devices to their records.
std::map<std::string, std::vector<ByDevice>> configurations_by_technique(
    std::span<const record::Record> records, Value value) {
  std::map<std::string, ByDevice> by_configuration;
  for (const record::Record& record : records) {
    if (record.outcome != record::Outcome::measured || !(value(record) > 0)) continue;
    by_configuration[record.configuration][record.device] = &record;
  }
  std::map<std::string, std::vector<ByDevice>> found;
  for (auto& [configuration, devices] : by_configuration) {
    if (devices.size() < 2) continue;
    found[devices.begin()->second->technique].push_back(std::move(devices));
  }
  return found;
}

template <typename Number>
double geometric_mean(const std::vector<ByDevice>& configurations, const std::string& device,
                      Number number) {
  double logs = 0;
  for (const ByDevice& each : configurations) logs += std::log(number(*each.at(device)));
  return std::exp(logs / static_cast<double>(configurations.size()));
}

// Returns the row of a technique. `shared` contains the configurations that were measured on all
// `devices`, and must not be empty.
SideBySide::Row row_of(const std::string& technique, const std::vector<ByDevice>& shared,
                       const std::set<std::string>& devices, Value value) {
  SideBySide::Row row{technique, shared.size(), {}, {}};
  for (const std::string& device : devices) {
    row.cells[device].value = geometric_mean(shared, device, value);
  }
  row.best = std::ranges::min_element(row.cells, {}, [](const auto& cell) {
               return cell.second.value;
             })->first;
  for (auto& [device, cell] : row.cells) {
    cell.ratio = cell.value / row.cells.at(row.best).value;
    for (const char* name : work_counters) {
      const auto count = [name](const record::Record& record) {
        return judge::count_of(record.counters, name).value_or(0);
      };
      const double work =
          geometric_mean(shared, device, count) / geometric_mean(shared, row.best, count);
      if (std::isfinite(work) && work > 0) cell.work[name] = work;
    }
  }
  return row;
}

// Returns whether all times were measured by device clocks. Times from different clocks are never
// compared.
bool all_times_from_device_clock(std::span<const record::Record> records) {
  return std::ranges::all_of(records, [](const record::Record& each) {
    return each.time_ns().empty() || each.clock() == "device";
  });
}

SideBySide table_of(std::span<const record::Record> records, std::string unit, Value value) {
  SideBySide table{.unit = std::move(unit), .clock = {}, .devices = {}, .rows = {}};
  std::set<std::string> all;
  for (auto& [technique, configurations] : configurations_by_technique(records, value)) {
    std::set<std::string> devices;
    for (const ByDevice& each : configurations) {
      for (const auto& [device, record] : each) devices.insert(device);
    }
    all.insert(devices.begin(), devices.end());
    std::erase_if(configurations,
                  [&](const ByDevice& each) { return each.size() < devices.size(); });
    if (configurations.empty()) continue;
    table.rows.push_back(row_of(technique, configurations, devices, value));
  }
  table.devices = {all.begin(), all.end()};
  return table;
}

}  // namespace

std::optional<SideBySide> side_by_side(std::span<const record::Record> records) {
  SideBySide table = table_of(records, "instructions", instructions_of);
  if (table.devices.empty()) {
    const bool use_device_clock = all_times_from_device_clock(records);
    table = table_of(records, "ns", use_device_clock ? device_time_of : wall_time_of);
    table.clock = use_device_clock ? "device" : "wall";
  }
  if (table.rows.empty()) return std::nullopt;
  return table;
}

}  // namespace triptych::comparison
