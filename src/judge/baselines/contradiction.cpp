#include "judge/baselines/contradiction.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "core/hash.hpp"
#include "core/json_file.hpp"
#include "core/json_text.hpp"
#include "judge/baselines/layout.hpp"
#include "record/check.hpp"

namespace triptych::judge {
namespace {

namespace fs = std::filesystem;
using record::Check;

// Returns the devices in a file of the form {configuration: {device: …}}.
std::set<std::string> devices_of(const fs::path& file) {
  std::set<std::string> devices;
  const auto json = core::JsonFile::read(file);
  if (!json) return devices;
  for (const auto& [configuration, values] : json->root().members()) {
    for (const auto& [device, value] : values.members()) devices.insert(device);
  }
  return devices;
}

// The content of counters.json: {configuration: {counter: {device: …}}}.
struct CounterTotals {
  std::size_t configurations = 0;
  std::set<std::string> devices;
};

CounterTotals counter_totals(const fs::path& folder) {
  CounterTotals totals;
  const auto json = core::JsonFile::read(folder / Layout::counters);
  if (!json) return totals;
  for (const auto& [configuration, counters] : json->root().members()) {
    ++totals.configurations;
    for (const auto& [counter, values] : counters.members()) {
      for (const auto& [device, value] : values.members()) {
        static_cast<void>(
            value.whole_number());  // throws an error with the line of an invalid value
        totals.devices.insert(device);
      }
    }
  }
  return totals;
}

std::string not_listed(const std::string& what) {
  return fmt::format("{} does not list {}", Layout::manifest, what);
}

// Looks for a driver that has a file or belongs to a machine, but is not listed in the manifest.
std::string unknown_driver(const fs::path& folder, const Manifest& manifest) {
  std::set<std::string> drivers;
  for (const auto& [id, known] : manifest.devices) drivers.insert(known.begin(), known.end());
  for (const char* subfolder :
       {Layout::cost_folder, Layout::code_folder, Layout::statistics_folder}) {
    if (!fs::is_directory(folder / subfolder)) continue;
    for (const auto& entry : fs::directory_iterator(folder / subfolder)) {
      const fs::path file = entry.path();
      if (file.extension() != ".json" || drivers.contains(file.stem().string())) continue;
      return not_listed(subfolder + file.filename().string());
    }
  }
  for (const std::set<std::string>& machine : manifest.machines) {
    for (const std::string& driver : machine) {
      if (!drivers.contains(driver))
        return not_listed("the driver " + driver + " for any device, but lists it for a machine");
    }
  }
  if (const auto lacking = core::JsonFile::read(folder / Layout::lacking)) {
    for (const auto& [driver, configurations] : lacking->root().members()) {
      if (!drivers.contains(driver)) {
        return not_listed(
            fmt::format("the driver {}, although {} contains it", driver, Layout::lacking));
      }
    }
  }
  return {};
}

std::string unknown_device(const Manifest& manifest, const std::set<std::string>& devices,
                           const char* file) {
  for (const std::string& id : devices) {
    if (!manifest.devices.contains(id)) {
      return not_listed(fmt::format("the device {}, although {} contains it", id, file));
    }
  }
  return {};
}

std::string unlisted_check(const fs::path& folder, const Manifest& manifest) {
  for (const auto& [check, file] :
       {std::pair{Check::accuracy, Layout::errors}, std::pair{Check::stress, Layout::scores}}) {
    if (fs::exists(folder / file) && !manifest.checks.contains(check)) {
      return not_listed(
          fmt::format("the check {}, although {} exists", record::name_of(check), file));
    }
  }
  return {};
}

// Compares the manifest with the hash in the last entry of history.json. Entries that were written
// by older versions of Triptych have no hash.
std::string unaccepted_manifest(const fs::path& folder) {
  const auto manifest = core::JsonFile::read(folder / Layout::manifest);
  const auto history = core::JsonFile::read(folder / Layout::history);
  if (!manifest || !history) return {};
  const auto entries = history->root().elements();
  if (entries.empty() || !entries.back().has("manifest")) return {};
  if (entries.back().at("manifest").text() == manifest_hash(manifest->value())) return {};
  return fmt::format("{} is not the most recently accepted manifest, according to {}",
                     Layout::manifest, Layout::history);
}

}  // namespace

std::string contradiction_in(const fs::path& folder, const Manifest& manifest) {
  std::string found = unknown_driver(folder, manifest);
  const auto keep_first = [&](std::string next) {
    if (found.empty()) found = std::move(next);
  };
  const CounterTotals totals = counter_totals(folder);
  keep_first(unknown_device(manifest, totals.devices, Layout::counters));
  keep_first(unknown_device(manifest, devices_of(folder / Layout::memory), Layout::memory));
  keep_first(unlisted_check(folder, manifest));
  if (totals.configurations != manifest.configurations) {
    keep_first(fmt::format("{} gives the number of configurations as {}, but {} contains {}",
                           Layout::manifest, manifest.configurations, Layout::counters,
                           totals.configurations));
  }
  keep_first(unaccepted_manifest(folder));
  return found;
}

std::string manifest_hash(core::Json manifest) {
  manifest.erase("files");
  return core::content_hash(core::json_text(manifest));
}

}  // namespace triptych::judge
