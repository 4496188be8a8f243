#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_io.hpp"
#include "core/json_file.hpp"
#include "judge/baselines/accepted.hpp"
#include "judge/baselines/accepted_values.hpp"
#include "judge/baselines/baselines.hpp"
#include "judge/baselines/contradiction.hpp"
#include "judge/baselines/drop_skipped.hpp"
#include "judge/baselines/layout.hpp"
#include "judge/baselines/next_folder.hpp"
#include "judge/baselines/reference_hash.hpp"
#include "record/has_image.hpp"

namespace triptych::judge {
namespace {

using core::Json;
using record::Check;

// Another mathematics library changes the last bits of a reference image, and another version of a
// compression library changes its file. Neither makes it a new reference image, so the following
// two functions compare hashes of quantized colours.

// Returns whether the file of a stored image contains the reference image with these hashes.
bool contains(const std::vector<std::byte>& file, const ReferenceHash& reference) {
  try {
    return is_same_reference(reference_hash(core::decode_exr(file)), reference);
  } catch (const core::InputError&) {
    return false;  // a damaged file is replaced
  }
}

// Returns whether the entry of a scene in images.json describes the reference image with these
// hashes.
bool describes(const Json& entry, const ReferenceHash& reference) {
  const Json stored = entry.is_object() ? entry.value("reference", Json()) : Json();
  if (!stored.is_array() || stored.size() != reference.size()) return false;
  return stored[0] == reference[0] || stored[1] == reference[1];
}

void update_image(const record::Record& record, const core::Image& reference,
                  const ReferenceHash& hash, NextFolder& next) {
  const std::string name = Layout::image(record.scene);
  const auto stored = next.files.find(name);
  const bool exists = stored != next.files.end();
  if (exists && contains(stored->second, hash)) return;
  next.lines.push_back(fmt::format("{}: {} ({})", name, exists ? "replaced" : "new", record.scene));
  next.files[name] = core::encode_exr(reference, core::ExrCompression::zip);
}

// Updates the hashes of the reference images in images.json. The images themselves are large, so
// they are stored only for plans that check both images and times (the quick plan of each suite).
// For these plans, the gate also compares the devices' images with the stored images.
void update_images(const Accepted& accepted, const AcceptRequest& request, NextFolder& next) {
  const bool stores_images =
      accepted.checks.contains(Check::image) && accepted.checks.contains(Check::timing);
  Update index(next, Layout::images);
  Json& table = index.object();
  if (accepted.replaces_all) keep_only(table, accepted.scenes);
  std::set<std::string> done;
  for (const record::Record& record : accepted.measured) {
    if (!record::has_image(record)) continue;
    if (done.insert(record.scene).second) {
      const core::Image reference = request.truth(record);
      const ReferenceHash hash = reference_hash(reference);
      if (stores_images) update_image(record, reference, hash, next);
      // The entry of a scene contains one hash of the data for each voxel format. The devices of
      // this run may not have used all formats, so the hashes for the other formats are kept,
      // unless the reference image has changed.
      Json& entry = table[record.scene];
      if (!describes(entry, hash)) entry = {{"reference", hash}};
    }
    if (!record.data_hash.empty()) {
      table[record.scene][Layout::data_key(record)] = record.data_hash;
    }
  }
  index.write(1);
  std::set<std::string> kept_images;
  for (const auto& item : table.items()) kept_images.insert(Layout::image(item.key()));
  std::erase_if(next.files, [&](const auto& file) {
    if (!file.first.starts_with("images/") || (stores_images && kept_images.contains(file.first)))
      return false;
    next.lines.push_back(file.first + ": removed");
    return true;
  });
}

record::Checks union_of(record::Checks checks, const record::Checks& more) {
  checks.insert(more.begin(), more.end());
  return checks;
}

// Returns the sets of drivers that were accepted together on one machine: the stored sets, and one
// set for each machine of this run. Leaves out sets that are contained in another set, and sets
// with only one driver.
Json machines_of(const Accepted& accepted, const Manifest& stored) {
  std::vector<std::set<std::string>> machines = stored.machines;
  for (const record::RunStart& begun : accepted.run.begun) {
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

// Returns the new manifest, without the file hashes.
Json next_manifest(const Accepted& accepted, const Manifest& stored, NextFolder& next) {
  // The hash and the checks of the plan are replaced only if the whole run is accepted.
  const bool replaces_plan = accepted.replaces_all || stored.plan_hash.empty();
  Json devices = stored.devices;
  for (const auto& [id, device] : accepted.devices) {
    std::set<std::string> drivers{device.statistics_key()};
    if (const auto known = stored.devices.find(id); known != stored.devices.end()) {
      drivers.insert(known->second.begin(), known->second.end());
    }
    devices[id] = drivers;
  }
  return {{"plan_hash", replaces_plan ? accepted.run.plan_hash : stored.plan_hash},
          {"checks", record::text_of(replaces_plan ? accepted.checks
                                                   : union_of(accepted.checks, stored.checks))},
          {"machines", machines_of(accepted, stored)},
          {"configurations", Update(next, Layout::counters).value().size()},
          {"devices", devices}};
}

// Adds an entry to history.json. `manifest` is the new manifest, without the file hashes.
void append_history(const Accepted& accepted, const AcceptRequest& request, const Json& manifest,
                    NextFolder& next) {
  std::set<std::string> ids;
  for (const auto& [id, device] : accepted.devices) ids.insert(id);
  Update history(next, Layout::history);
  if (!history.value().is_array()) history.value() = Json::array();
  history.value().push_back({{"date", request.date},
                             {"reason", request.reason},
                             {"devices", ids},
                             {"manifest", manifest_hash(manifest)}});
  next.files[Layout::history] = bytes_of(core::to_lines(history.value(), 1));
}

void write_manifest(Json manifest, NextFolder& next) {
  Json files = Json::object();
  next.files.erase(Layout::manifest);
  for (const auto& [name, content] : next.files) files[name] = core::content_hash(content);
  manifest["files"] = std::move(files);
  next.files[Layout::manifest] = bytes_of(core::to_lines(manifest, 2));
}

// Returns a folder with all files that are stored now, or an empty folder if the stored files are
// damaged and --drop discards them.
NextFolder next_folder_of(const Baselines& stored, const AcceptRequest& request) {
  NextFolder next{.folder = stored.folder(), .files = {}, .lines = {}};
  if (!stored.problem().empty()) {
    if (request.drop && request.only.empty()) return next;
    throw core::InputError(fmt::format(
        "{}: {}; restore the baselines from version control, or discard all of them by accepting a "
        "complete run with --drop",
        stored.folder().string(), stored.problem()));
  }
  for (const auto& [name, hash] : stored.manifest().files) {
    next.files.emplace(name, core::read_file(next.folder / name));
  }
  return next;
}

}  // namespace

std::vector<std::string> accept(const record::Store& store, const std::string& run,
                                const std::filesystem::path& root, const AcceptRequest& request) {
  const Accepted accepted = select_accepted(store, run, request);
  refuse_incomplete(store, accepted, request);
  refuse_other_data(accepted, request);
  const WriterLock lock(root);
  const Baselines stored(root, request.plan);
  NextFolder next = next_folder_of(stored, request);
  const Manifest stored_manifest = next.files.empty() ? Manifest{} : stored.manifest();
  if (!next.files.empty()) refuse_part(accepted, stored, run, request);
  update_images(accepted, request, next);
  update_values(store, accepted, request, next);
  drop_skipped(accepted.skipped, accepted.devices, next);
  update_lacking(accepted, stored_manifest, next);
  Json new_manifest = next_manifest(accepted, stored_manifest, next);
  append_history(accepted, request, new_manifest, next);
  write_manifest(std::move(new_manifest), next);
  replace_folder(next.folder, next.files, request.on_written);
  return next.lines;
}

}  // namespace triptych::judge
