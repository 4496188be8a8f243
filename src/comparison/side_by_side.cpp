#include "comparison/side_by_side.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "estimation/statistics.hpp"
#include "judge/baselines/frame_change.hpp"

namespace triptych::comparison {
namespace {

using Value = double (*)(const record::Record&);  // returns 0 if the record has no value

// A quantity that the table compares.
struct Measure {
  std::string unit;   // SideBySide::unit
  std::string clock;  // SideBySide::clock
  Value value;
};

// The records of one configuration on one device, one for each run. The first is from the run whose
// configurations the table contains.
using Runs = std::vector<const record::Record*>;
using ByDevice = std::map<std::string, Runs>;

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
  std::map<std::string, std::string> first_runs;
  for (const record::Record& record : records) first_runs.emplace(record.device, record.run);
  std::map<std::string, ByDevice> by_configuration;
  for (const record::Record& record : records) {
    if (record.outcome != record::Outcome::measured || !(value(record) > 0)) continue;
    Runs& runs = by_configuration[record.configuration][record.device];
    const bool first = record.run == first_runs.at(record.device);
    runs.insert(first ? runs.begin() : runs.end(), &record);
  }
  std::map<std::string, std::vector<ByDevice>> found;
  for (auto& [configuration, devices] : by_configuration) {
    std::erase_if(devices, [&](const auto& each) {
      return each.second.front()->run != first_runs.at(each.first);
    });
    if (devices.size() < 2) continue;
    const std::string technique = devices.begin()->second.front()->technique;
    found[technique].push_back(std::move(devices));
  }
  return found;
}

// An estimate of the mean ln(value) of a device over the configurations of a row, with the variance
// of this estimate. The variance is nullopt if there are too few samples.
struct LogMean {
  double estimate = 0;
  std::optional<double> variance = 0;
  double degrees = 0;  // degrees of freedom of `variance`
  std::size_t runs = 1;
};

// Returns, for each run that contains all configurations, the mean ln(value) over them.
std::vector<double> run_means(const std::vector<ByDevice>& configurations,
                              const std::string& device, Value value) {
  std::vector<double> means;
  for (const record::Record* first : configurations.front().at(device)) {
    double sum = 0;
    bool complete = true;
    for (const ByDevice& each : configurations) {
      const Runs& runs = each.at(device);
      const auto found = std::ranges::find(runs, first->run, &record::Record::run);
      complete = complete && found != runs.end();
      if (complete) sum += std::log(value(**found));
    }
    if (complete) means.push_back(sum / static_cast<double>(configurations.size()));
  }
  return means;
}

// The variance of the logarithm of a median of normally distributed samples is π/2 times the
// variance of their mean.
constexpr double variance_of_median = std::numbers::pi / 2;

LogMean log_mean(const std::vector<ByDevice>& configurations, const std::string& device,
                 const Measure& measure) {
  const std::vector<double> means = run_means(configurations, device, measure.value);
  LogMean result{.estimate = estimation::mean(means), .runs = means.size()};
  if (measure.clock.empty()) return result;
  if (means.size() > 1) {
    result.variance = estimation::sample_variance(means) / static_cast<double>(means.size());
    result.degrees = static_cast<double>(means.size() - 1);
    return result;
  }
  const auto count = static_cast<double>(configurations.size());
  for (const ByDevice& each : configurations) {
    std::vector<double> logs;
    for (const double ns : each.at(device).front()->time_ns_by(measure.clock)) {
      if (ns > 0) logs.push_back(std::log(ns));
    }
    if (logs.size() < 2) {
      result.variance.reset();
      return result;
    }
    *result.variance += variance_of_median * estimation::sample_variance(logs) /
                        static_cast<double>(logs.size()) / (count * count);
    result.degrees += static_cast<double>(logs.size() - 1);
  }
  return result;
}

// Returns the confidence interval of the difference between two devices, with the degrees of
// freedom by Welch and Satterthwaite.
std::optional<Interval> interval_of(const LogMean& device, const LogMean& best) {
  constexpr double tail = 0.01;
  if (!device.variance || !best.variance) return std::nullopt;
  const double difference = device.estimate - best.estimate;
  const double variance = *device.variance + *best.variance;
  if (variance == 0) return Interval{difference, difference};
  const double degrees = variance * variance /
                         (*device.variance * *device.variance / device.degrees +
                          *best.variance * *best.variance / best.degrees);
  const double half_width =
      estimation::student_t_upper_quantile(tail, degrees) * std::sqrt(variance);
  return Interval{difference - half_width, difference + half_width};
}

double mean_count(const std::vector<ByDevice>& configurations, const std::string& device,
                  const char* name) {
  double logs = 0;
  for (const ByDevice& each : configurations) {
    logs += std::log(judge::count_of(each.at(device).front()->counters, name).value_or(0));
  }
  return std::exp(logs / static_cast<double>(configurations.size()));
}

// Returns the row of a technique. `shared` contains the configurations that were measured on all
// `devices`, and must not be empty.
SideBySide::Row row_of(const std::string& technique, const std::vector<ByDevice>& shared,
                       const std::map<std::string, LogMean>& means) {
  SideBySide::Row row{technique, shared.size(), {}, {}};
  row.best = std::ranges::min_element(means, {}, [](const auto& each) {
               return each.second.estimate;
             })->first;
  const LogMean& best = means.at(row.best);
  for (const auto& [device, mean] : means) {
    SideBySide::Cell& cell = row.cells[device];
    cell.value = std::exp(mean.estimate);
    cell.ratio = std::exp(mean.estimate - best.estimate);
    if (device != row.best) cell.interval = interval_of(mean, best);
    for (const char* name : work_counters) {
      const double work = mean_count(shared, device, name) / mean_count(shared, row.best, name);
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

SideBySide table_of(std::span<const record::Record> records, const Measure& measure) {
  SideBySide table{.unit = measure.unit, .clock = measure.clock, .devices = {}, .rows = {}};
  std::set<std::string> all;
  std::optional<std::size_t> fewest_runs;
  for (auto& [technique, configurations] : configurations_by_technique(records, measure.value)) {
    std::set<std::string> devices;
    for (const ByDevice& each : configurations) {
      for (const auto& [device, runs] : each) devices.insert(device);
    }
    all.insert(devices.begin(), devices.end());
    std::erase_if(configurations,
                  [&](const ByDevice& each) { return each.size() < devices.size(); });
    if (configurations.empty()) continue;
    std::map<std::string, LogMean> means;
    for (const std::string& device : devices) {
      const LogMean& mean = means[device] = log_mean(configurations, device, measure);
      fewest_runs = std::min(fewest_runs.value_or(mean.runs), mean.runs);
    }
    table.rows.push_back(row_of(technique, configurations, means));
  }
  table.devices = {all.begin(), all.end()};
  table.process_runs = fewest_runs.value_or(1);
  return table;
}

}  // namespace

bool SideBySide::Row::is_significant() const {
  return std::ranges::all_of(cells, [this](const auto& cell) {
    return cell.first == best || cell.second.is_significant();
  });
}

std::optional<SideBySide> side_by_side(std::span<const record::Record> records) {
  SideBySide table = table_of(records, {"instructions", "", instructions_of});
  if (table.devices.empty()) {
    const bool device = all_times_from_device_clock(records);
    table = table_of(records, device ? Measure{"ns", "device", device_time_of}
                                     : Measure{"ns", "wall", wall_time_of});
  }
  if (table.rows.empty()) return std::nullopt;
  return table;
}

}  // namespace triptych::comparison
