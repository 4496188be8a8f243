#include "judge/baselines/accepted_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "accuracy/cases.hpp"
#include "core/error.hpp"
#include "core/glob.hpp"
#include "estimation/statistics.hpp"
#include "judge/baselines/drop_skipped.hpp"
#include "judge/baselines/layout.hpp"
#include "judge/stress/stress.hpp"

namespace triptych::judge {

using core::Json;
using record::Check;

void keep_only(Json& object, const std::set<std::string>& kept) {
  for (auto item = object.begin(); item != object.end();) {
    item = kept.contains(item.key()) ? std::next(item) : object.erase(item);
  }
}

namespace {

// Prepares a table {configuration: …} for new values. If the run replaces everything, removes the
// configurations that the run does not contain.
Json& prepared_table(Json& table, const Accepted& accepted) {
  if (!table.is_object()) table = Json::object();
  if (accepted.replaces_all) keep_only(table, accepted.configurations);
  return table;
}

void update_counters(const Accepted& accepted, Update& update) {
  Json& table = prepared_table(update.value(), accepted);
  for (const record::Record& record : accepted.measured) {
    erase_from(table, record.configuration, record.device);
    Json& counters = table[record.configuration];
    if (!counters.is_object()) counters = Json::object();
    for (const auto& [counter, value] : record.counters) counters[counter][record.device] = value;
  }
}

void update_memory(const Accepted& accepted, Update& update) {
  Json& table = prepared_table(update.value(), accepted);
  for (const record::Record& record : accepted.measured) {
    erase_from(table, record.configuration, record.device);
    if (!record.memory.empty()) table[record.configuration][record.device] = record.memory;
  }
}

bool has_counters(const Json& table, const record::Record& record) {
  const auto counters = table.find(record.configuration);
  return counters != table.end() && std::ranges::any_of(*counters, [&](const Json& values) {
           return values.contains(record.device);
         });
}

// Counters are stored by device, not by driver version. If the accepted driver version does not
// support a configuration that another version supports, the counters stay, and lacking.json lists
// the configuration for this version.
void update_lacking_table(const Accepted& accepted, const Manifest& stored, const Json& counters,
                          Update& update) {
  Json& table = update.object();
  std::map<std::string, std::set<std::string>> lacking;
  for (const auto& [driver, configurations] : table.items()) {
    lacking[driver] = configurations.get<std::set<std::string>>();
  }
  const auto driver_of = [&](const record::Record& record) {
    return accepted.devices.at(record.device).statistics_key();
  };
  for (const record::Record& record : accepted.measured) {
    lacking[driver_of(record)].erase(record.configuration);
  }
  for (const record::Record& record : accepted.unsupported) {
    const auto known = stored.devices.find(record.device);
    const bool has_other_drivers = known != stored.devices.end() &&
                                   known->second.size() > known->second.count(driver_of(record));
    if (has_other_drivers && has_counters(counters, record)) {
      lacking[driver_of(record)].insert(record.configuration);
    }
  }
  table = Json::object();
  for (auto& [driver, configurations] : lacking) {
    std::erase_if(configurations, [&](const auto& each) { return !counters.contains(each); });
    if (!configurations.empty()) table[driver] = configurations;
  }
}

// Writes the error of each record's image against the limit image of its scene (the image with
// exact ray integrals).
void update_errors(const record::Store& store, const Accepted& accepted,
                   const AcceptRequest& request, Update& update) {
  Json& table = prepared_table(update.value(), accepted);
  for (const record::Record& record : accepted.measured) {
    const accuracy::LimitImage* limit = request.limit(record);
    if (limit == nullptr) erase_from(table, record.configuration, record.device);
    if (limit == nullptr || record.image.empty()) continue;
    const auto error = accuracy::limit_errors(store.decoded_image(record.image),
                                              request.truth(record), limit->image);
    if (!error) continue;
    table[record.configuration][record.device] = {{"rmse", error->rmse},
                                                  {"arithmetic", error->arithmetic}};
  }
}

// Writes the score of each stress case (a scene on which renderers often fail) on each device of
// the run, including cases that failed.
void update_scores(const record::Store& store, const Accepted& accepted,
                   const AcceptRequest& request, Update& update) {
  Json& table = prepared_table(update.value(), accepted);
  const std::vector<record::Record> records = store.records(accepted.run.id);
  for (const ScoredRecord& scored : score_stress(store, records, *request.stress)) {
    const std::string& configuration = scored.record->configuration;
    if (!request.only.empty() && !core::glob_matches(request.only, configuration)) continue;
    table[configuration][scored.record->device] = scored.score.points();
  }
}

// Removes the counts that are not stored, because they differ between two processes of the same
// program. The gate only shows these counts.
record::Counts comparable_parts(record::Counts cost) {
  cost.erase("libc");
  cost.erase("program");
  return cost;
}

// Writes the instruction counts. Counts from another emulator (the program that counts
// instructions) are not comparable with the stored counts, so they must replace all stored counts
// of the device. Rejects such counts with --only, which would replace only some of the stored
// counts.
void update_cost(const Accepted& accepted, const record::Device& device, NextFolder& next) {
  Update update(next, Layout::cost(device));
  bool counted = false;
  for (const record::Record& record : accepted.measured) {
    if (record.device != device.id || record.cost.empty()) continue;
    Json& file = update.object();
    if (file.value("counted_by", "") != record.counted_by) {
      const bool loses_values = !accepted.replaces_all && file.contains("configurations");
      if (counted || loses_values) {
        const std::string other_emulator = file.value("counted_by", "");
        throw core::InputError(
            counted ? fmt::format("run {}: the instruction counts for {} are not comparable, "
                                  "because {} counted some of them and {} the others; measure "
                                  "the plan again with one emulator",
                                  record.run, device.id, other_emulator, record.counted_by)
                    : fmt::format("run {}: the instruction counts for {} are not comparable with "
                                  "the stored counts, because they were counted by {}, but the "
                                  "stored counts by {}; accept the whole plan, without --only",
                                  record.run, device.id, record.counted_by, other_emulator));
      }
      file = {{"device", device.id},
              {"driver_version", device.driver_version},
              {"counted_by", record.counted_by}};
    }
    counted = true;
    prepared_table(file["configurations"], accepted)[record.configuration] = {
        {"frame", comparable_parts(record.cost)},
        {"prepare", comparable_parts(record.prepare_cost)}};
  }
  update.write(3);
}

// Writes the code statistics, except for infinite values, which JSON cannot represent.
void update_code(const Accepted& accepted, const record::Device& device, NextFolder& next) {
  Update update(next, Layout::code(device));
  bool has_code = false;
  for (const record::Record& record : accepted.measured) {
    if (record.device != device.id || record.code.empty()) continue;
    has_code = true;
    Json& file = update.object();
    file["device"] = device.id;
    file["driver_version"] = device.driver_version;
    Json code = Json::object();
    for (const auto& [name, executable] : record.code) {
      Json& entry = code[name] = Json::object();
      if (!executable.assembly.empty()) entry["assembly"] = executable.assembly;
      for (const auto& [statistic, value] : executable.statistics) {
        if (std::isfinite(value)) entry[statistic] = value;
      }
    }
    prepared_table(file["configurations"], accepted)[record.configuration] = std::move(code);
  }
  if (has_code) update.write(4);
}

// Writes the pipeline statistics. If an untimed run did not read the statistics of a configuration,
// keeps the stored values.
void update_statistics(const Accepted& accepted, const record::Device& device, NextFolder& next) {
  Update update(next, Layout::statistics(device));
  update.object()["device"] = device.statistics_key();
  // For statistics that this run did not calibrate, the stored calibration is kept.
  for (const auto& [statistic, worth] : device.statistics_calibration) {
    update.object()["calibration"][statistic] = worth;
  }
  Json& table = prepared_table(update.object()["configurations"], accepted);
  bool has_statistics = !table.empty();
  for (const record::Record& record : accepted.measured) {
    if (record.device != device.id) continue;
    if (record.untimed() && record.statistics.empty()) continue;
    table[record.configuration] = record.statistics;
    has_statistics = has_statistics || !record.statistics.empty();
  }
  if (has_statistics) update.write(3);
}

void update_timings(const Accepted& accepted, const record::Device& device, NextFolder& next) {
  Update update(next, Layout::timings(device));
  update.object()["device"] = device.key();
  Json& table = prepared_table(update.object()["configurations"], accepted);
  std::size_t kept_values = 0;
  for (const record::Record& record : accepted.measured) {
    if (record.device != device.id) continue;
    if (record.untimed() && table.contains(record.configuration)) ++kept_values;
    const std::vector<double>& times = record.time_ns();
    if (times.empty()) continue;
    table[record.configuration] = {{"clock", record.clock()},
                                   {"median_ns", estimation::median(times)},
                                   {"spread", log_spread(times)},
                                   {"frames", times.size()},
                                   {"kernel_hash", record.kernel_hash}};
  }
  if (!table.empty()) update.write(2);
  if (kept_values > 0) {
    next.lines.push_back(
        fmt::format("{}: kept the stored times and statistics of {} configurations, because the "
                    "run was untimed",
                    device.id, kept_values));
  }
}

}  // namespace

void update_lacking(const Accepted& accepted, const Manifest& stored, NextFolder& next) {
  const Update counters(next, Layout::counters);
  Update update(next, Layout::lacking);
  update_lacking_table(accepted, stored, counters.value(), update);
  if (update.value().empty()) {
    next.files.erase(Layout::lacking);
  } else {
    update.write(2);
  }
}

void update_values(const record::Store& store, const Accepted& accepted,
                   const AcceptRequest& request, NextFolder& next) {
  const auto update = [&](const char* name, const auto& act) {
    Update file(next, name);
    act(file);
    if (!file.object().empty() || next.files.contains(name)) file.write(2);
  };
  update(Layout::counters, [&](Update& file) { update_counters(accepted, file); });
  update(Layout::memory, [&](Update& file) { update_memory(accepted, file); });
  if (accepted.checks.contains(Check::accuracy) && request.limit) {
    update(Layout::errors, [&](Update& file) { update_errors(store, accepted, request, file); });
  }
  if (accepted.checks.contains(Check::stress) && request.stress) {
    update(Layout::scores, [&](Update& file) { update_scores(store, accepted, request, file); });
  }
  const bool keeps_times = accepted.checks.contains(Check::timing);
  if (!keeps_times) next.drop_folder("timings/");
  for (const auto& [id, device] : accepted.devices) {
    update_cost(accepted, device, next);
    update_code(accepted, device, next);
    update_statistics(accepted, device, next);
    if (keeps_times) update_timings(accepted, device, next);
  }
}

}  // namespace triptych::judge
