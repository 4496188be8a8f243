#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/glob.hpp"
#include "core/image_io.hpp"
#include "core/json_text.hpp"
#include "judge/baselines/baselines.hpp"
#include "judge/baselines/json_file.hpp"
#include "judge/baselines/layout.hpp"
#include "judge/images/has_picture.hpp"
#include "judge/statistics/statistics.hpp"

namespace triptych::judge {
namespace {

using core::Json;

constexpr std::size_t kept_timings = 20;
constexpr std::size_t listed_values = 40;

// The part of a run that is to be accepted.
struct Accepted {
  std::vector<record::Record> measured;
  std::map<std::string, record::Device> devices;  // by id
  // Configurations and scenes the run has any record of; used only when everything is replaced.
  bool replaces_all = false;
  std::set<std::string> configurations;
  std::set<std::string> scenes;
};

// Remembers what changes in a file, writes it when anything does.
class Update {
 public:
  Update(std::filesystem::path file, const std::filesystem::path& folder)
      : file_(std::move(file)), name_(file_.lexically_relative(folder).string()) {
    if (const auto stored = JsonFile::read(file_)) before_ = stored->value();
    after_ = before_;
  }

  [[nodiscard]] bool is_stored() const { return !before_.is_null(); }
  Json& value() { return after_; }
  Json& object() {
    if (!after_.is_object()) after_ = Json::object();
    return after_;
  }

  void write(int depth, std::vector<std::string>& lines) const {
    if (after_ == before_) return;
    std::filesystem::create_directories(file_.parent_path());
    core::write_file(to_lines(after_, depth), file_);
    describe(lines);
  }

 private:
  void describe(std::vector<std::string>& lines) const {
    const Json before = flat(before_);
    const Json after = flat(after_);
    std::vector<std::string> values;
    std::size_t added = 0;
    for (const auto& item : after.items()) {
      const auto old = before.find(item.key());
      if (old == before.end()) ++added;
      if (old == before.end() || *old == item.value()) continue;
      values.push_back(fmt::format("  {}: {} → {}", readable(item.key()), core::json_text(*old),
                                   core::json_text(item.value())));
    }
    const auto removed = std::ranges::count_if(
        before.items(), [&](const auto& item) { return !after.contains(item.key()); });
    lines.push_back(
        fmt::format("{}: {} changed, {} added, {} removed", name_, values.size(), added, removed));
    const std::size_t shown = std::min(values.size(), listed_values);
    lines.insert(lines.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(shown));
    if (values.size() > shown)
      lines.push_back(fmt::format("  … and {} more", values.size() - shown));
  }

  static Json flat(const Json& value) { return value.is_null() ? Json::object() : value.flatten(); }
  // JSON pointer without its escapes.
  static std::string readable(std::string pointer) {
    constexpr std::array<std::pair<std::string_view, char>, 2> escapes{{{"~1", '/'}, {"~0", '~'}}};
    for (const auto& [escape, character] : escapes) {
      for (auto at = pointer.find(escape); at != std::string::npos;
           at = pointer.find(escape, at + 1)) {
        pointer.replace(at, escape.size(), 1, character);
      }
    }
    return pointer.substr(1);
  }

  std::filesystem::path file_;
  std::string name_;
  Json before_;
  Json after_;
};

void drop_all_but(Json& object, const std::set<std::string>& kept) {
  for (auto item = object.begin(); item != object.end();) {
    item = kept.contains(item.key()) ? std::next(item) : object.erase(item);
  }
}

Json& configurations_of(Update& update, const std::string& device, const Accepted& accepted) {
  Json& file = update.object();
  file["device"] = device;
  Json& table = file["configurations"];
  if (!table.is_object()) table = Json::object();
  if (accepted.replaces_all) drop_all_but(table, accepted.configurations);
  return table;
}

void update_counters(const Accepted& accepted, Update& update) {
  Json& table = update.object();
  if (accepted.replaces_all) drop_all_but(table, accepted.configurations);
  for (const record::Record& record : accepted.measured) {
    Json& counters = table[record.configuration];
    if (!counters.is_object()) counters = Json::object();
    for (Json& values : counters) values.erase(record.device);
    for (const auto& [counter, value] : record.counters) counters[counter][record.device] = value;
    for (auto item = counters.begin(); item != counters.end();) {
      item = item->empty() ? counters.erase(item) : std::next(item);
    }
  }
}

// Each record's error against the limit of its scene, on the device it was measured on.
void update_errors(const record::Store& store, const Accepted& accepted,
                   const AcceptRequest& request, Update& update) {
  Json& table = update.object();
  if (accepted.replaces_all) drop_all_but(table, accepted.configurations);
  for (const record::Record& record : accepted.measured) {
    const LimitPicture* limit = record.image.empty() ? nullptr : request.limit(record);
    if (limit == nullptr) continue;
    const auto error = picture_error(core::decode_exr(store.image(record.image)),
                                     request.truth(record), limit->image);
    if (!error) continue;
    table[record.configuration][record.device] = {{"rmse", error->rmse},
                                                  {"arithmetic", error->arithmetic}};
  }
}

// What each configuration scored on each device of the run; one that failed has a score too.
void update_scores(const record::Store& store, const std::vector<record::Record>& records,
                   const Accepted& accepted, const AcceptRequest& request, Update& update) {
  Json& table = update.object();
  if (accepted.replaces_all) drop_all_but(table, accepted.configurations);
  for (const StressScored& scored : score_stress(store, records, *request.stress)) {
    const std::string& configuration = scored.record->configuration;
    if (!request.only.empty() && !core::glob_matches(request.only, configuration)) continue;
    table[configuration][scored.record->device] = scored.score.points();
  }
}

void update_bits(const record::Record& record, Json& table) {
  if (record.image.empty()) {
    table.erase(record.configuration);
  } else {
    table[record.configuration] = {{"image", record.image}, {"kernel_hash", record.kernel_hash}};
  }
}

void update_timings(const record::Record& record, bool forget, Json& table) {
  if (record.time_ns().empty()) return;
  Json& runs = table[record.configuration];
  if (!runs.is_array() || forget) runs = Json::array();
  Json kept = Json::array();
  for (const Json& entry : runs) {
    if (entry.value("run", "") != record.run) kept.push_back(entry);
  }
  Json entry{{"run", record.run},
             {"median_ns", median(record.time_ns())},
             {"clock", record.clock()},
             {"kernel_hash", record.kernel_hash}};
  if (record.clock() != "wall" && !record.wall_ns.empty()) {
    entry["median_wall_ns"] = median(record.wall_ns);
  }
  kept.push_back(std::move(entry));
  while (kept.size() > kept_timings) kept.erase(kept.begin());
  runs = std::move(kept);
}

void write_device_files(const Accepted& accepted, const record::Device& device, bool forget_times,
                        const Layout& layout, std::vector<std::string>& lines) {
  Update bits(layout.bits(device), layout.folder);
  Update statistics(layout.statistics(device), layout.folder);
  Update timings(layout.timings(device), layout.folder);
  Json& bits_table = configurations_of(bits, device.key(), accepted);
  Json& statistics_table = configurations_of(statistics, device.statistics_key(), accepted);
  Json& timings_table = configurations_of(timings, device.key(), accepted);
  // What a run did not look at leaves what is known of this driver version.
  for (const auto& [statistic, worth] : device.statistics_dialect) {
    statistics.object()["dialect"][statistic] = worth;
  }
  bool tells_statistics = !statistics_table.empty();
  std::size_t kept = 0;  // what an untimed run says nothing of
  for (const record::Record& record : accepted.measured) {
    if (record.device != device.id) continue;
    update_bits(record, bits_table);
    if (record.untimed()) {
      if (timings_table.contains(record.configuration)) ++kept;
      continue;
    }
    statistics_table[record.configuration] = record.statistics;
    tells_statistics = tells_statistics || !record.statistics.empty();
    update_timings(record, forget_times, timings_table);
  }
  bits.write(2, lines);
  if (tells_statistics) statistics.write(3, lines);
  if (!timings_table.empty() || timings.is_stored()) timings.write(3, lines);
  if (kept > 0) {
    lines.push_back(fmt::format(
        "{}: times and statistics of {} configurations stay as stored, the run was untimed",
        device.id, kept));
  }
}

void remove_unlisted_images(const Json& listed, const Layout& layout,
                            std::vector<std::string>& lines) {
  std::set<std::string> names;
  for (const Json& entry : listed) names.insert(entry.at("file").get<std::string>());
  std::set<std::filesystem::path> unlisted;
  for (const auto& entry : std::filesystem::directory_iterator(layout.image_folder())) {
    if (entry.path().extension() == ".exr" && !names.contains(entry.path().filename().string())) {
      unlisted.insert(entry.path());
    }
  }
  for (const auto& path : unlisted) {
    std::filesystem::remove(path);
    lines.push_back(fmt::format("images/{}: removed", path.filename().string()));
  }
}

void write_images(const Accepted& accepted, const AcceptRequest& request, const Layout& layout,
                  std::vector<std::string>& lines) {
  Update index(layout.images(), layout.folder);
  Json& table = index.object();
  if (accepted.replaces_all) drop_all_but(table, accepted.scenes);
  std::filesystem::create_directories(layout.image_folder());
  std::set<std::string> done;
  for (const record::Record& record : accepted.measured) {
    if (!has_picture(record) || !done.insert(record.scene).second) continue;
    const std::vector<std::byte> bytes = core::encode_exr(request.truth(record));
    const std::string hash = core::content_hash(bytes);
    const std::string name = Layout::image_name(record.scene);
    const auto path = layout.image_folder() / name;
    const bool exists = std::filesystem::exists(path);
    if (!exists || core::content_hash(core::read_file(path)) != hash) {
      core::write_file(bytes, path);
      lines.push_back(
          fmt::format("images/{}: {} ({})", name, exists ? "replaced" : "new", record.scene));
    }
    // Other devices' voxel formats have their own hashes of the data; they hold with the truth.
    Json& entry = table[record.scene];
    if (!entry.is_object() || entry.value("hash", "") != hash) entry = Json::object();
    entry["file"] = name;
    entry["hash"] = hash;
  }
  for (const record::Record& record : accepted.measured) {
    if (!has_picture(record) || record.data_hash.empty()) continue;
    table[record.scene][Layout::data_key(record)] = record.data_hash;
  }
  index.write(1, lines);
  remove_unlisted_images(table, layout, lines);
}

void append_history(const Accepted& accepted, const std::string& run, const AcceptRequest& request,
                    const Layout& layout, const std::vector<std::string>& lines) {
  std::set<std::string> keys;
  for (const auto& [id, device] : accepted.devices) keys.insert(device.key());
  Update history(layout.history(), layout.folder);
  if (!history.value().is_array()) history.value() = Json::array();
  history.value().push_back({{"date", request.date},
                             {"reason", request.reason},
                             {"run", run},
                             {"devices", keys},
                             {"changes", lines}});
  std::vector<std::string> unused;
  history.write(3, unused);
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
    if (!record.planted.empty()) {
      throw core::InputError(
          fmt::format("run {} holds the planted fault '{}' ({} on {}); it is never a baseline", run,
                      record.planted, record.configuration, record.device));
    }
  }
}

Accepted select(const record::Store& store, const std::string& run, const AcceptRequest& request) {
  const std::vector<record::Record> records = store.records(run);
  refuse_unfit(records, run, request);
  Accepted accepted;
  accepted.replaces_all = request.only.empty();
  for (const record::Record& record : records) {
    accepted.configurations.insert(record.configuration);
    accepted.scenes.insert(record.scene);
    const bool wanted =
        request.only.empty() || core::glob_matches(request.only, record.configuration);
    if (wanted && record.outcome == record::Outcome::measured) accepted.measured.push_back(record);
  }
  if (accepted.measured.empty()) {
    throw core::InputError(
        fmt::format("run {} measured nothing{}", run,
                    request.only.empty() ? "" : " that matches " + request.only));
  }
  std::set<std::string> measured_devices;
  for (const record::Record& record : accepted.measured) measured_devices.insert(record.device);
  for (const auto& entry : store.devices(run)) {
    if (measured_devices.contains(entry.device.id)) {
      accepted.devices.emplace(entry.device.id, entry.device);
    }
  }
  return accepted;
}

// A shard, a run with --set or one that was cut short would take the rest of the plan with it.
void refuse_part(const Accepted& accepted, const Baselines& stored, const std::string& run,
                 const AcceptRequest& request) {
  if (!accepted.replaces_all || request.drop) return;
  const std::vector<std::string> known = stored.configurations();
  std::vector<std::string> missing;
  std::ranges::set_difference(known, accepted.configurations, std::back_inserter(missing));
  if (missing.empty()) return;
  throw core::InputError(fmt::format(
      "run {} has no record of {} of {} stored configurations ({}{}): finish it with triptych run "
      "{} --resume, accept what it has with --only GLOB, or drop them with --drop where the plan "
      "has them no longer",
      run, missing.size(), known.size(), missing.front(), missing.size() > 1 ? "; …" : "",
      record::plan_argument(request.plan)));
}

// Reads every file first: a corrupt one is reported before anything is written.
void check_stored(const Accepted& accepted, const Baselines& stored) {
  const std::string& any = accepted.measured.front().configuration;
  (void)stored.counters(any);
  (void)stored.errors(any);
  (void)stored.scores(any);
  for (const auto& [id, device] : accepted.devices) {
    (void)stored.bits(device, any);
    (void)stored.statistics(device, any);
    (void)stored.timings(device, any);
    (void)stored.accepted_before(device);
  }
}

}  // namespace

std::vector<std::string> accept(const record::Store& store, const std::string& run,
                                const std::filesystem::path& root, const AcceptRequest& request) {
  const Accepted accepted = select(store, run, request);
  const Baselines stored(root, request.plan);
  check_stored(accepted, stored);
  refuse_part(accepted, stored, run, request);
  const Layout layout{stored.folder()};
  std::vector<std::string> lines;
  write_images(accepted, request, layout, lines);
  Update counters(layout.counters(), layout.folder);
  update_counters(accepted, counters);
  counters.write(2, lines);
  if (request.limit) {
    Update errors(layout.errors(), layout.folder);
    update_errors(store, accepted, request, errors);
    errors.write(2, lines);
  }
  if (request.stress) {
    Update scores(layout.scores(), layout.folder);
    update_scores(store, store.records(run), accepted, request, scores);
    scores.write(2, lines);
  }
  for (const auto& [id, device] : accepted.devices) {
    write_device_files(accepted, device, request.forget_times, layout, lines);
  }
  append_history(accepted, run, request, layout, lines);
  return lines;
}

}  // namespace triptych::judge
