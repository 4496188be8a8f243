#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/glob.hpp"
#include "core/image_io.hpp"
#include "core/json_file.hpp"
#include "core/quoting.hpp"
#include "estimation/statistics.hpp"
#include "judge/baselines/baselines.hpp"
#include "judge/baselines/drop_skipped.hpp"
#include "judge/baselines/layout.hpp"
#include "judge/baselines/next_folder.hpp"
#include "record/has_picture.hpp"

namespace triptych::judge {
namespace {

using core::Json;
using record::Check;

// The part of a run that is to be accepted.
struct Accepted {
  record::Run run;
  record::Checks checks;
  std::vector<record::Record> measured;
  std::vector<record::Record> skipped;            // to be dropped from the baselines
  std::map<std::string, record::Device> devices;  // by id
  // The configurations and scenes of which the run has a record; used only if everything is
  // replaced.
  bool replaces_all = false;
  std::set<std::string> configurations;
  std::set<std::string> scenes;
};

void drop_all_but(Json& object, const std::set<std::string>& kept) {
  for (auto item = object.begin(); item != object.end();) {
    item = kept.contains(item.key()) ? std::next(item) : object.erase(item);
  }
}

// {configuration: …}, without the configurations that are removed.
Json& table_of(Json& table, const Accepted& accepted) {
  if (!table.is_object()) table = Json::object();
  if (accepted.replaces_all) drop_all_but(table, accepted.configurations);
  return table;
}

void update_counters(const Accepted& accepted, Update& update) {
  Json& table = table_of(update.value(), accepted);
  for (const record::Record& record : accepted.measured) {
    erase_from(table, record.configuration, record.device);
    Json& counters = table[record.configuration];
    if (!counters.is_object()) counters = Json::object();
    for (const auto& [counter, value] : record.counters) counters[counter][record.device] = value;
  }
}

void update_memory(const Accepted& accepted, Update& update) {
  Json& table = table_of(update.value(), accepted);
  for (const record::Record& record : accepted.measured) {
    erase_from(table, record.configuration, record.device);
    if (!record.memory.empty()) table[record.configuration][record.device] = record.memory;
  }
}

// The error of each record against the limit of its scene, on the device that measured it.
void update_errors(const record::Store& store, const Accepted& accepted,
                   const AcceptRequest& request, Update& update) {
  Json& table = table_of(update.value(), accepted);
  for (const record::Record& record : accepted.measured) {
    const accuracy::LimitPicture* limit = request.limit(record);
    if (limit == nullptr) erase_from(table, record.configuration, record.device);
    if (limit == nullptr || record.image.empty()) continue;
    const auto error =
        accuracy::picture_error(store.picture(record.image), request.truth(record), limit->image);
    if (!error) continue;
    table[record.configuration][record.device] = {{"rmse", error->rmse},
                                                  {"arithmetic", error->arithmetic}};
  }
}

// The score of each configuration on each device of the run. A configuration that failed also has a
// score.
void update_scores(const record::Store& store, const Accepted& accepted,
                   const AcceptRequest& request, Update& update) {
  Json& table = table_of(update.value(), accepted);
  const std::vector<record::Record> records = store.records(accepted.run.id);
  for (const StressScored& scored : score_stress(store, records, *request.stress)) {
    const std::string& configuration = scored.record->configuration;
    if (!request.only.empty() && !core::glob_matches(request.only, configuration)) continue;
    table[configuration][scored.record->device] = scored.score.points();
  }
}

// The counts that are stored. Counts that differ between two process runs are shown by the gate and
// not stored.
record::Counts kept_of(record::Counts cost) {
  cost.erase("libc");
  cost.erase("program");
  return cost;
}

// Counts by another emulator are different quantities. They replace everything that is stored,
// which those of --only must not do.
void update_cost(const Accepted& accepted, const record::Device& device, NextFolder& next) {
  Update update(next, Layout::cost(device));
  bool counted = false;
  for (const record::Record& record : accepted.measured) {
    if (record.device != device.id || record.cost.empty()) continue;
    Json& file = update.object();
    if (file.value("counted_by", "") != record.counted_by) {
      const bool loses = !accepted.replaces_all && file.contains("configurations");
      if (counted || loses) {
        throw core::InputError(
            fmt::format("run {}: {} was counted by {} and by {}{}", record.run, device.id,
                        file.value("counted_by", ""), record.counted_by,
                        counted ? "" : ": accept the whole plan, without --only"));
      }
      file = {{"device", device.id},
              {"driver_version", device.driver_version},
              {"counted_by", record.counted_by}};
    }
    counted = true;
    table_of(file["configurations"], accepted)[record.configuration] = {
        {"frame", kept_of(record.cost)}, {"prepare", kept_of(record.prepare_cost)}};
  }
  update.write(3);
}

// Infinite statistics are not stored, because JSON has no such number.
void update_code(const Accepted& accepted, const record::Device& device, NextFolder& next) {
  Update update(next, Layout::code(device));
  bool any = false;
  for (const record::Record& record : accepted.measured) {
    if (record.device != device.id || record.code.empty()) continue;
    any = true;
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
    table_of(file["configurations"], accepted)[record.configuration] = std::move(code);
  }
  if (any) update.write(4);
}

// Of untimed records whose statistics were not read nothing is known: what is stored of them stays.
void update_statistics(const Accepted& accepted, const record::Device& device, NextFolder& next) {
  Update update(next, Layout::statistics(device));
  update.object()["device"] = device.statistics_key();
  // Statistics that the run did not calibrate keep what is known about this driver version.
  for (const auto& [statistic, worth] : device.statistics_calibration) {
    update.object()["calibration"][statistic] = worth;
  }
  Json& table = table_of(update.object()["configurations"], accepted);
  bool tells = !table.empty();
  for (const record::Record& record : accepted.measured) {
    if (record.device != device.id) continue;
    if (record.untimed() && record.statistics.empty()) continue;
    table[record.configuration] = record.statistics;
    tells = tells || !record.statistics.empty();
  }
  if (tells) update.write(3);
}

void update_timings(const Accepted& accepted, const record::Device& device, NextFolder& next) {
  Update update(next, Layout::timings(device));
  update.object()["device"] = device.key();
  Json& table = table_of(update.object()["configurations"], accepted);
  std::size_t kept = 0;
  for (const record::Record& record : accepted.measured) {
    if (record.device != device.id) continue;
    if (record.untimed() && table.contains(record.configuration)) ++kept;
    const std::vector<double>& times = record.time_ns();
    if (times.empty()) continue;
    table[record.configuration] = {{"clock", record.clock()},
                                   {"median_ns", estimation::median(times)},
                                   {"spread", log_spread(times)},
                                   {"frames", times.size()},
                                   {"kernel_hash", record.kernel_hash}};
  }
  if (!table.empty()) update.write(2);
  if (kept > 0) {
    next.lines.push_back(fmt::format(
        "{}: times and statistics of {} configurations stay as stored, the run was untimed",
        device.id, kept));
  }
}

void update_image(const record::Record& record, const core::Image& reference, NextFolder& next) {
  const std::string name = Layout::image(record.scene);
  std::vector<std::byte> bytes = core::encode_exr(reference);
  const auto known = next.files.find(name);
  const bool exists = known != next.files.end();
  if (exists && known->second == bytes) return;
  next.lines.push_back(fmt::format("{}: {} ({})", name, exists ? "replaced" : "new", record.scene));
  next.files[name] = std::move(bytes);
}

// Images are large. They are stored only for plans that measure times, because their report shows
// them.
void update_images(const Accepted& accepted, const AcceptRequest& request, NextFolder& next) {
  const bool keeps =
      accepted.checks.contains(Check::image) && accepted.checks.contains(Check::timing);
  Update index(next, Layout::images);
  Json& table = index.object();
  if (accepted.replaces_all) drop_all_but(table, accepted.scenes);
  std::set<std::string> done;
  for (const record::Record& record : accepted.measured) {
    if (!record::has_picture(record)) continue;
    if (done.insert(record.scene).second) {
      const core::Image reference = request.truth(record);
      if (keeps) update_image(record, reference, next);
      // The voxel formats of other devices have hashes of their own for the data, which stay valid
      // as long as the reference image does.
      Json& entry = table[record.scene];
      const Json hash = reference_hash(reference);
      if (!entry.is_object() || entry.value("reference", Json()) != hash) {
        entry = {{"reference", hash}};
      }
    }
    if (!record.data_hash.empty()) {
      table[record.scene][Layout::data_key(record)] = record.data_hash;
    }
  }
  index.write(1);
  std::set<std::string> kept;
  for (const auto& item : table.items()) kept.insert(Layout::image(item.key()));
  std::erase_if(next.files, [&](const auto& file) {
    if (!file.first.starts_with("images/") || (keeps && kept.contains(file.first))) return false;
    next.lines.push_back(file.first + ": removed");
    return true;
  });
}

void append_history(const Accepted& accepted, const AcceptRequest& request, NextFolder& next) {
  std::set<std::string> ids;
  for (const auto& [id, device] : accepted.devices) ids.insert(id);
  Update history(next, Layout::history);
  if (!history.value().is_array()) history.value() = Json::array();
  history.value().push_back({{"date", request.date}, {"reason", request.reason}, {"devices", ids}});
  next.files[Layout::history] = bytes_of(core::to_lines(history.value(), 1));
}

record::Checks all_of(record::Checks checks, const record::Checks& more) {
  checks.insert(more.begin(), more.end());
  return checks;
}

// Adds the drivers that were accepted on each machine of the run. A set that is contained in
// another one is left out.
Json machines_of(const Accepted& accepted, const Manifest& stored) {
  std::vector<std::set<std::string>> machines = stored.machines;
  for (const record::Beginning& begun : accepted.run.begun) {
    std::set<std::string>& drivers = machines.emplace_back();
    for (const std::string& id : begun.devices) {
      const auto device = accepted.devices.find(id);
      if (device != accepted.devices.end()) drivers.insert(device->second.statistics_key());
    }
  }
  std::ranges::sort(machines);
  const auto repeated = std::ranges::unique(machines);
  machines.erase(repeated.begin(), repeated.end());
  Json kept = Json::array();
  for (const auto& each : machines) {
    const bool is_part = std::ranges::any_of(machines, [&](const auto& other) {
      return &other != &each && std::ranges::includes(other, each);
    });
    if (each.size() > 1 && !is_part) kept.push_back(each);
  }
  return kept;
}

void write_manifest(const Accepted& accepted, const Manifest& stored, NextFolder& next) {
  // A part of a run says nothing about the plan as a whole.
  const bool whole = accepted.replaces_all || stored.plan_hash.empty();
  Json devices = stored.devices;
  for (const auto& [id, device] : accepted.devices) {
    std::set<std::string> drivers{device.statistics_key()};
    if (const auto known = stored.devices.find(id); known != stored.devices.end()) {
      drivers.insert(known->second.begin(), known->second.end());
    }
    devices[id] = drivers;
  }
  Json files = Json::object();
  next.files.erase(Layout::manifest);
  for (const auto& [name, content] : next.files) files[name] = core::content_hash(content);
  const Json manifest{
      {"plan_hash", whole ? accepted.run.plan_hash : stored.plan_hash},
      {"checks", record::text_of(whole ? accepted.checks : all_of(accepted.checks, stored.checks))},
      {"machines", machines_of(accepted, stored)},
      {"configurations",
       whole ? std::max<std::uint64_t>(accepted.run.configurations, accepted.configurations.size())
             : stored.configurations},
      {"devices", devices},
      {"files", files}};
  next.files[Layout::manifest] = bytes_of(core::to_lines(manifest, 2));
}

void refuse_unfit(const std::vector<record::Record>& records, const std::string& run,
                  const AcceptRequest& request) {
  if (request.reason.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw core::InputError("accepting needs a reason (--reason TEXT)");
  }
  for (const record::Record& record : records) {
    if (record.plan != request.plan) {
      throw core::InputError(
          fmt::format("run {} is of plan {}, not of {}", run, record.plan, request.plan));
    }
    if (!record.injected.empty()) {
      throw core::InputError(
          fmt::format("run {} holds the injected fault '{}' ({} on {}); it is never a baseline",
                      run, record.injected, record.configuration, record.device));
    }
  }
}

Accepted select(const record::Store& store, const std::string& run, const AcceptRequest& request) {
  const std::vector<record::Record> records = store.records(run);
  refuse_unfit(records, run, request);
  Accepted accepted;
  for (record::Run& each : store.runs()) {
    if (each.id == run) accepted.run = std::move(each);
  }
  accepted.checks = checked_in(accepted.run);
  accepted.replaces_all = request.only.empty();
  for (const record::Record& record : records) {
    accepted.configurations.insert(record.configuration);
    accepted.scenes.insert(record.scene);
    const bool wanted =
        request.only.empty() || core::glob_matches(request.only, record.configuration);
    if (wanted && record.outcome == record::Outcome::measured) accepted.measured.push_back(record);
    const bool drops = request.drop && !request.only.empty();
    if (wanted && drops && record.outcome == record::Outcome::skipped) {
      accepted.skipped.push_back(record);
    }
  }
  if (accepted.measured.empty() && accepted.skipped.empty()) {
    throw core::InputError(
        fmt::format("run {} measured nothing{}", run,
                    request.only.empty() ? "" : " that matches " + request.only));
  }
  std::set<std::string> told_of;
  for (const record::Record& record : accepted.measured) told_of.insert(record.device);
  for (const record::Record& record : accepted.skipped) told_of.insert(record.device);
  for (const auto& entry : store.devices(run)) {
    if (told_of.contains(entry.device.id)) accepted.devices.emplace(entry.device.id, entry.device);
  }
  return accepted;
}

// The reference image is drawn from the present data. If the run used data with another hash, the
// result would be a baseline that no run can meet.
void refuse_other_data(const Accepted& accepted, const AcceptRequest& request) {
  if (!request.data_hash) return;
  for (const record::Record& record : accepted.measured) {
    if (record.data_hash.empty()) continue;
    const std::string now = request.data_hash(record);
    if (now.empty() || now == record.data_hash) continue;
    throw core::InputError(fmt::format(
        "the data of {} are not those that run {} measured (content hash {}, now {}): restore "
        "them, or measure again",
        record.configuration, record.run, record.data_hash, now));
  }
}

// A shard, a run with --set or a run that was cut short would delete the rest of the plan.
void refuse_part(const Accepted& accepted, const Baselines& stored, const std::string& run,
                 const AcceptRequest& request) {
  if (!accepted.replaces_all || request.drop) return;
  const std::vector<std::string> known = stored.configurations();
  std::vector<std::string> missing;
  std::ranges::set_difference(known, accepted.configurations, std::back_inserter(missing));
  if (missing.empty()) return;
  throw core::InputError(fmt::format(
      "run {} has no record of {} of {} stored configurations ({}{}): finish it with triptych run "
      "{} --resume{}, accept what it has with --only GLOB, or drop them with --drop where the plan "
      "has them no longer",
      run, missing.size(), known.size(), missing.front(), missing.size() > 1 ? "; …" : "",
      core::shell_quoted(request.argument.empty() ? record::plan_argument(request.plan)
                                                  : request.argument),
      request.store_option));
}

// If there are no baselines yet, a run that was cut short would make baselines for only a part of
// the plan.
void refuse_incomplete(const record::Store& store, const Accepted& accepted,
                       const AcceptRequest& request) {
  if (!accepted.replaces_all || request.drop) return;
  const std::vector<std::string> planned = store.planned(accepted.run);
  for (const std::string& device : record::devices_of(accepted.run.begun)) {
    const std::set<std::string> there = store.configurations(accepted.run.id, device);
    std::vector<std::string> missing;
    std::ranges::set_difference(planned, there, std::back_inserter(missing));
    if (missing.empty()) continue;
    throw core::InputError(fmt::format(
        "run {} was cut short: of {} configurations on {} it has no record of {} ({}{}); finish it "
        "with triptych run {} --resume{}, accept what it has with --only GLOB, or with --drop",
        accepted.run.id, planned.size(), device, missing.size(), missing.front(),
        missing.size() > 1 ? "; …" : "",
        core::shell_quoted(request.argument.empty() ? record::plan_argument(request.plan)
                                                    : request.argument),
        request.store_option));
  }
}

// Everything that is stored, as it was accepted; empty if it is to be dropped.
NextFolder next_of(const Baselines& stored, const AcceptRequest& request) {
  NextFolder next{.folder = stored.folder(), .files = {}, .lines = {}};
  if (!stored.problem().empty()) {
    if (request.drop && request.only.empty()) return next;
    throw core::InputError(
        fmt::format("{}: {}: restore it from version control, or accept a whole run with --drop",
                    stored.folder().string(), stored.problem()));
  }
  for (const auto& [name, hash] : stored.manifest().files) {
    next.files.emplace(name, core::read_file(next.folder / name));
  }
  return next;
}

}  // namespace

record::Checks checked_in(const record::Run& run) {
  if (!run.checks.empty()) return run.checks;
  return {Check::image, Check::counters, Check::statistics,
          Check::cost,  Check::memory,   Check::timing};
}

std::vector<std::string> accept(const record::Store& store, const std::string& run,
                                const std::filesystem::path& root, const AcceptRequest& request) {
  const Accepted accepted = select(store, run, request);
  refuse_incomplete(store, accepted, request);
  refuse_other_data(accepted, request);
  const WriterLock lock(root);
  const Baselines stored(root, request.plan);
  NextFolder next = next_of(stored, request);
  const Manifest manifest = next.files.empty() ? Manifest{} : stored.manifest();
  if (!next.files.empty()) refuse_part(accepted, stored, run, request);
  update_images(accepted, request, next);
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
  drop_skipped(accepted.skipped, accepted.devices, next);
  append_history(accepted, request, next);
  write_manifest(accepted, manifest, next);
  replace_folder(next.folder, next.files, request.on_written);
  return next.lines;
}

}  // namespace triptych::judge
