#include "judge/baselines/baselines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "core/json_file.hpp"
#include "judge/baselines/baseline_files.hpp"
#include "judge/baselines/contradiction.hpp"
#include "judge/baselines/layout.hpp"

namespace triptych::judge {
namespace fs = std::filesystem;
namespace {

template <typename Table>
auto find_optional(const Table& table, const std::string& name) {
  const auto found = table.find(name);
  return found == table.end() ? std::optional<typename Table::mapped_type>{}
                              : std::optional(found->second);
}

// Reads all files of a folder that contains one file for each driver.
template <typename Value, typename Read>
ByName<Value> read_drivers(const fs::path& folder, const Read& read) {
  ByName<Value> drivers;
  for (const auto& [driver, path] : files_in(folder)) {
    if (const auto file = core::JsonFile::read(path)) drivers.emplace(driver, read(file->root()));
  }
  return drivers;
}

template <typename Value>
const Value* find_driver(const ByName<Value>& drivers, const record::Device& device) {
  const auto found = drivers.find(device.statistics_key());
  return found == drivers.end() ? nullptr : &found->second;
}

}  // namespace

// The files that have been read so far.
struct Baselines::Cache {
  fs::path folder;
  std::optional<Manifest> manifest;
  std::optional<std::string> problem;
  std::optional<ByName<StoredImage>> images;
  std::optional<ByName<StoredCounters>> counters;
  std::optional<ByName<ByName<record::Counts>>> memory;
  std::optional<ByName<ByName<StoredError>>> errors;
  std::optional<ByName<ByName<std::uint64_t>>> scores;
  std::optional<ByName<std::set<std::string>>> lacking;
  std::optional<ByName<DriverCost>> cost;
  std::optional<ByName<DriverCode>> code;
  std::map<fs::path, ByName<record::Counts>> statistics;
  std::map<fs::path, ByName<record::StatisticWorth>> calibrations;
  std::map<fs::path, ByName<StoredTiming>> timings;
  std::optional<std::vector<Waiver>> waivers;
  std::optional<std::vector<AbsentDevice>> absent_devices;

  // Returns the content of a file of the form {configuration: …}, which is read only once.
  template <typename Value, typename Read>
  const ByName<Value>& table(std::optional<ByName<Value>>& known, const char* file,
                             const Read& read) {
    if (!known) known = read_table<Value>(folder / file, read);
    return *known;
  }
  const ByName<StoredCounters>& all_counters() {
    return table(counters, Layout::counters, read_counters);
  }
  const ByName<StoredImage>& stored_images() {
    return table(images, Layout::images, read_stored_image);
  }
  // Returns how exactly the driver counts each statistic (its calibration). The calibration is in
  // the same file as the statistics. It is missing if the driver was not calibrated when it was
  // accepted.
  const ByName<record::StatisticWorth>& calibration_of(const fs::path& path) {
    const auto known = calibrations.find(path);
    if (known != calibrations.end()) return known->second;
    ByName<record::StatisticWorth> calibration;
    if (const auto file = core::JsonFile::read(path);
        file && file->value().contains("calibration")) {
      calibration =
          read_members<record::StatisticWorth>(file->root().at("calibration"), read_worth);
    }
    return calibrations.emplace(path, std::move(calibration)).first->second;
  }
  const ByName<record::Counts>& statistics_of(const fs::path& path) {
    const auto known = statistics.find(path);
    if (known != statistics.end()) return known->second;
    return statistics
        .emplace(path, read_device_table<record::Counts>(path, path.stem().string(), read_counts))
        .first->second;
  }
};

Baselines::Baselines(fs::path root, std::string_view plan)
    : root_(std::move(root)), folder_(root_ / plan), cache_(std::make_shared<Cache>()) {
  cache_->folder = folder_;
}

bool Baselines::present() const {
  return fs::is_directory(folder_) && problem().empty();
}

const std::string& Baselines::problem() const {
  if (cache_->problem) return *cache_->problem;
  std::string problem;
  if (!fs::is_directory(folder_)) {
    // There are no baselines, so nothing can be wrong with them.
  } else if (!fs::exists(folder_ / Layout::manifest)) {
    problem = std::string(Layout::manifest) + " is missing";
  } else {
    try {
      problem = first_change(folder_, manifest());
    } catch (const core::InputError& error) {  // for example after a merge conflict
      problem = error.what();
    }
    try {
      if (problem.empty()) problem = contradiction_in(folder_, manifest());
    } catch (const core::InputError&) {
      // The error is ignored here, because the check that reads the file reports it, together with
      // the line number.
    }
  }
  cache_->problem = std::move(problem);
  return *cache_->problem;
}

const Manifest& Baselines::manifest() const {
  if (!cache_->manifest) {
    const auto file = core::JsonFile::read(folder_ / Layout::manifest);
    cache_->manifest = file ? read_manifest(file->root()) : Manifest{};
  }
  return *cache_->manifest;
}

std::string Baselines::data_hash(const record::Record& record) const {
  const auto stored = find_optional(cache_->stored_images(), record.scene);
  if (!stored) return {};
  return find_optional(stored->data, Layout::data_key(record)).value_or(std::string{});
}

std::optional<core::Image> Baselines::image(const std::string& scene) const {
  const fs::path path = folder_ / Layout::image(scene);
  if (!fs::exists(path)) return std::nullopt;
  return core::read_exr(path);
}

std::optional<ReferenceHash> Baselines::reference(const std::string& scene) const {
  const auto stored = find_optional(cache_->stored_images(), scene);
  return stored ? std::optional(stored->reference) : std::nullopt;
}

std::optional<StoredCounters> Baselines::counters(const std::string& configuration) const {
  return find_optional(cache_->all_counters(), configuration);
}

bool Baselines::was_measured(const std::string& device, const std::string& configuration) const {
  const auto stored = counters(configuration).value_or(StoredCounters{});
  return std::ranges::any_of(stored,
                             [&](const auto& each) { return each.second.contains(device); });
}

bool Baselines::lacks(const record::Device& device, const std::string& configuration) const {
  const auto lacking = find_optional(cache_->table(cache_->lacking, Layout::lacking, read_names),
                                     device.statistics_key());
  return lacking && lacking->contains(configuration);
}

std::map<std::string, record::Counts> Baselines::memory(const std::string& configuration) const {
  return find_optional(cache_->table(cache_->memory, Layout::memory, read_memory), configuration)
      .value_or(ByName<record::Counts>{});
}

std::map<std::string, StoredError> Baselines::errors(const std::string& configuration) const {
  return find_optional(cache_->table(cache_->errors, Layout::errors, read_errors), configuration)
      .value_or(ByName<StoredError>{});
}

std::map<std::string, std::uint64_t> Baselines::scores(const std::string& configuration) const {
  // read_counts can be used, because the scores have the same form as counters: {name: integer}.
  return find_optional(cache_->table(cache_->scores, Layout::scores, read_counts), configuration)
      .value_or(record::Counts{});
}

const std::map<std::string, DriverCost>& Baselines::cost_of_all_drivers() const {
  if (!cache_->cost) {
    cache_->cost = read_drivers<DriverCost>(folder_ / Layout::cost_folder, read_cost);
  }
  return *cache_->cost;
}

const DriverCost* Baselines::cost(const record::Device& device) const {
  return find_driver(cost_of_all_drivers(), device);
}

const std::map<std::string, DriverCode>& Baselines::code_of_all_drivers() const {
  if (!cache_->code) {
    cache_->code = read_drivers<DriverCode>(folder_ / Layout::code_folder, read_code);
  }
  return *cache_->code;
}

const DriverCode* Baselines::code(const record::Device& device) const {
  return find_driver(code_of_all_drivers(), device);
}

bool Baselines::has_statistics(const record::Device& device) const {
  return !cache_->statistics_of(folder_ / Layout::statistics(device)).empty();
}

std::optional<record::Counts> Baselines::statistics(const record::Device& device,
                                                    const std::string& configuration) const {
  return find_optional(cache_->statistics_of(folder_ / Layout::statistics(device)), configuration);
}

std::map<std::string, record::Counts> Baselines::statistics_of_all_drivers(
    const std::string& configuration) const {
  std::map<std::string, record::Counts> result;
  for (const auto& [driver, path] : files_in(folder_ / Layout::statistics_folder)) {
    const auto counts = find_optional(cache_->statistics_of(path), configuration);
    if (counts) result.emplace(driver, *counts);
  }
  return result;
}

std::map<std::string, record::StatisticWorth> Baselines::statistics_calibration(
    const std::string& driver) const {
  return cache_->calibration_of(folder_ / (Layout::statistics_folder + driver + ".json"));
}

const std::map<std::string, StoredTiming>& Baselines::timings(const record::Device& device) const {
  const fs::path path = folder_ / Layout::timings(device);
  const auto known = cache_->timings.find(path);
  if (known != cache_->timings.end()) return known->second;
  return cache_->timings
      .emplace(path, read_device_table<StoredTiming>(path, device.key(), read_timing))
      .first->second;
}

std::vector<std::string> Baselines::configurations() const {
  std::vector<std::string> result;
  for (const auto& [configuration, counters] : cache_->all_counters()) {
    result.push_back(configuration);
  }
  return result;
}

const std::vector<AbsentDevice>& Baselines::absent_devices() const {
  if (!cache_->absent_devices) cache_->absent_devices = read_absent_devices(absent_file());
  return *cache_->absent_devices;
}

const std::vector<Waiver>& Baselines::waivers(const std::string& today) const {
  if (!cache_->waivers) cache_->waivers = read_waivers(waivers_file(), today);
  return *cache_->waivers;
}

bool Baselines::has_plan(const std::string& plan) const {
  return fs::is_directory(root_ / plan);
}

}  // namespace triptych::judge
