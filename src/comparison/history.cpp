#include "comparison/history.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "core/glob.hpp"
#include "judge/baselines/baselines.hpp"

namespace triptych::comparison {
namespace {

std::map<std::string, MeasurementsByConfiguration> measurements_by_device(
    const record::Store& store) {
  std::map<std::string, MeasurementsByConfiguration> devices;
  for (const record::Run& run : record::latest_runs(store)) {
    store.visit_records(run.id, [&](const record::Record& record) {
      Measurement& here = devices[record.device][run.plan + " " + record.configuration];
      here.injected = record.injected;
      if (record.outcome != record::Outcome::measured) return;
      const auto time = record::summarise(
          record.wall_ns);  // wall-clock times, because every timed record has them
      here.cost = record.instructions();
      if (!time) return;
      here.time = time->median;
      here.time_spread = judge::log_spread(record.wall_ns);
      here.clock = record.clock();
    });
  }
  return devices;
}

// Returns the shortest suffix of the store's path that is unique among the stores: the file name,
// preceded by as many folders as necessary.
std::string shortest_unique_suffix(const std::string& store, const std::set<std::string>& stores) {
  std::filesystem::path name;
  const std::filesystem::path path(store);
  for (auto part = path.end(); part != path.begin();) {
    --part;
    name = name.empty() ? *part : *part / name;
    const std::string end = name.string();
    const bool shared = std::ranges::any_of(stores, [&](const std::string& other) {
      return other != store && (other == end || other.ends_with("/" + end));
    });
    if (!shared) break;
  }
  return name.string();
}

}  // namespace

const HistoryPoint* DeviceHistory::first_worse() const {
  const auto found = std::ranges::find(points, true, &HistoryPoint::worse);
  return found == points.end() ? nullptr : &*found;
}

std::vector<record::Store*> sorted_by_time(const std::vector<record::Store*>& stores) {
  using Begun = std::pair<std::string, record::Store*>;
  std::vector<Begun> begun;
  for (record::Store* store : stores) {
    const auto runs = store->runs();
    begun.emplace_back(runs.empty() ? std::string() : runs.front().started_at, store);
  }
  std::ranges::stable_sort(begun, {}, &Begun::first);
  std::vector<record::Store*> sorted;
  for (const auto& [time, store] : begun) sorted.push_back(store);
  return sorted;
}

DeviceHistory& HistoryBuilder::history_of(const std::string& device) {
  const auto found = std::ranges::find(history_, device, &DeviceHistory::device);
  if (found != history_.end()) return *found;
  history_.push_back({.device = device, .points = {}});
  return history_.back();
}

HistoryBuilder::Points HistoryBuilder::points_of(const record::Store& store) const {
  Points points;
  const auto runs = store.runs();
  for (const record::Run& run : record::latest_runs(store)) {
    for (const auto& entry : store.devices(run.id)) {
      const record::Device& device = entry.device;
      if (!devices_.empty() && !core::any_glob_matches(devices_, device.id)) continue;
      HistoryPoint& point = points[device.id];
      point.store = store.file().string();
      point.started_at = runs.front().started_at;
      point.driver_version = device.driver_version;
      const auto version = run.system.find("triptych");
      if (version != run.system.end()) point.triptych = version->second;
    }
  }
  return points;
}

const record::Store* HistoryBuilder::DeviceState::previous_store(
    const std::string& configuration) const {
  const auto found = latest_with.find(configuration);
  return found == latest_with.end() ? last : found->second;
}

void HistoryBuilder::add_changes(const record::Store& store,
                                 const std::map<std::string, MeasurementsByConfiguration>& measured,
                                 measure::Truths& truths, Points& points) const {
  std::map<const record::Store*, std::set<std::string>> devices_by_previous_store;
  for (const auto& [id, point] : points) {
    const auto known = known_.find(id);
    if (known == known_.end()) continue;
    devices_by_previous_store[known->second.last].insert(id);
    const auto here = measured.find(id);
    if (here == measured.end()) continue;
    for (const auto& [configuration, amounts] : here->second) {
      devices_by_previous_store[known->second.previous_store(configuration)].insert(id);
    }
  }
  std::map<std::string, DeviceChange> changes;
  for (const auto& [before, devices] : devices_by_previous_store) {
    for (DeviceChange& change :
         diff_stores(*before, store, {devices.begin(), devices.end()}, truths).devices) {
      const DeviceState& known = known_.at(change.b.id);
      std::erase_if(change.configurations, [&, before = before](const ConfigurationDiff& each) {
        return known.previous_store(each.key) != before;
      });
      DeviceChange& all = changes[change.b.id];
      if (before == known.last) all.device = std::move(change.device);
      std::ranges::move(change.configurations, std::back_inserter(all.configurations));
    }
  }
  for (const auto& [id, change] : changes) {
    points[id].changes = groups_of(change);
    points[id].worse = change.has(DifferenceKind::regression);
  }
}

// Computes the index of one store (HistoryPoint::cost or HistoryPoint::time), which is 1 for the
// first store, and updates `chain`, which contains the most recent value of each configuration.
// Returns nullopt if this store has no values, or if none of its configurations has a value in an
// earlier store.
std::optional<double> HistoryBuilder::extend_chain(Chain& chain,
                                                   const MeasurementsByConfiguration& here,
                                                   std::optional<double> Measurement::*value) {
  double sum = 0;
  int count = 0;
  for (const auto& [configuration, amounts] : here) {
    const auto before = chain.find(configuration);
    if (!(amounts.*value) || before == chain.end()) continue;
    sum += std::log(*(amounts.*value) / before->second.measured * before->second.index);
    ++count;
  }
  if (count == 0 && !chain.empty()) return std::nullopt;
  const double now = count > 0 ? std::exp(sum / count) : 1;
  for (const auto& [configuration, amounts] : here) {
    if (amounts.*value) chain.insert_or_assign(configuration, Link{*(amounts.*value), now});
  }
  return chain.empty() ? std::nullopt : std::optional(now);
}

void HistoryBuilder::add_times(DeviceState& known, const MeasurementsByConfiguration& here,
                               HistoryPoint& point) {
  std::vector<TimePair> pairs;
  for (const auto& [configuration, now] : here) {
    if (!now.time) continue;
    const auto found = known.timed.find(configuration);
    if (found != known.timed.end()) {
      const Measurement& before = found->second;
      pairs.push_back({*before.time, *now.time, before.time_spread, now.time_spread});
      if (before.clock != now.clock) ++point.changed_clocks[{before.clock, now.clock}];
    }
    known.timed.insert_or_assign(configuration, now);
  }
  point.time_change = time_change(pairs);
}

void HistoryBuilder::add(const record::Store& store, measure::Truths& truths) {
  const auto measured = measurements_by_device(store);
  Points points = points_of(store);
  add_changes(store, measured, truths, points);
  for (auto& [id, point] : points) {
    DeviceState& known = known_[id];
    known.last = &store;
    if (const auto here = measured.find(id); here != measured.end()) {
      point.cost = extend_chain(known.cost, here->second, &Measurement::cost);
      point.time = extend_chain(known.time, here->second, &Measurement::time);
      add_times(known, here->second, point);
      for (const auto& [configuration, amounts] : here->second) {
        known.latest_with[configuration] = &store;
        if (!amounts.injected.empty()) point.injected.insert(amounts.injected);
      }
    }
    history_of(id).points.push_back(std::move(point));
  }
}

std::map<std::string, std::string> names_of(const std::vector<DeviceHistory>& history) {
  std::set<std::string> stores;
  for (const DeviceHistory& device : history) {
    for (const HistoryPoint& point : device.points) stores.insert(point.store);
  }
  std::map<std::string, std::string> names;
  for (const std::string& store : stores) names[store] = shortest_unique_suffix(store, stores);
  return names;
}

}  // namespace triptych::comparison
