#include "judge/gate/anchor_run.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

#include "judge/gate/confirmation.hpp"
#include "judge/statistics/statistics.hpp"
#include "judge/timing/anchor.hpp"

namespace triptych::judge {
namespace {

using std::chrono::seconds;

// The beginning of an id as measure::run_plan makes it, 20261121T191943Z; nullopt for other ids.
std::optional<std::chrono::sys_seconds> time_of(const std::string& run) {
  int year = 0;
  unsigned month = 0;
  unsigned day = 0;
  int hour = 0;
  int minute = 0;
  int second = 0;
  const int read = std::sscanf(run.c_str(), "%4d%2u%2uT%2d%2d%2dZ", &year, &month, &day, &hour,
                               &minute, &second);
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month),
                                         std::chrono::day(day)};
  if (read != 6 || !date.ok()) return std::nullopt;
  return std::chrono::sys_days(date) + std::chrono::hours(hour) + std::chrono::minutes(minute) +
         seconds(second);
}

std::optional<std::string> latest_anchors(const record::Store& store, const std::string& run) {
  std::set<std::string> anchor_runs;
  for (const record::Run& each : store.runs()) {
    if (each.plan == anchors_plan) anchor_runs.insert(each.id);
  }
  return anchors_beside(run, anchor_runs);
}

std::vector<record::Record> anchors_in(const RunView& view, const record::Store& store,
                                       const std::string& run) {
  const auto beside = latest_anchors(store, run);
  if (!beside) return {};
  std::set<std::string> same;
  for (const auto& entry : store.devices(*beside)) {
    const auto judged = view.devices.find(entry.device.id);
    if (judged != view.devices.end() && judged->second.key() == entry.device.key()) {
      same.insert(entry.device.id);
    }
  }
  std::vector<record::Record> anchors;
  for (record::Record& record : store.records(*beside)) {
    if (same.contains(record.device) && has_time(record)) anchors.push_back(std::move(record));
  }
  return anchors;
}

}  // namespace

std::optional<std::string> anchors_beside(const std::string& run,
                                          const std::set<std::string>& anchor_runs) {
  constexpr std::chrono::hours longest{1};
  const auto after = anchor_runs.upper_bound(run);
  if (after == anchor_runs.begin()) return std::nullopt;
  const std::string& latest = *std::prev(after);
  const auto then = time_of(latest);
  const auto now = time_of(run);
  if (then && now && *now - *then > longest) return std::nullopt;
  return latest;
}

bool has_time(const record::Record& record) {
  if (record.outcome != record::Outcome::measured || record.time_ns().empty()) return false;
  const double time = median(record.time_ns());
  return time > 0 && std::isfinite(time);
}

std::vector<record::Record> anchors_of(const RunView& view) {
  if (view.records.empty()) return {};
  std::vector<record::Record> anchors = anchors_in(view, view.store, view.records.front().run);
  for (const Launch& launch : view.again) {
    join_launches(anchors, anchors_in(view, *launch.store, launch.run), *launch.devices);
  }
  return anchors;
}

}  // namespace triptych::judge
