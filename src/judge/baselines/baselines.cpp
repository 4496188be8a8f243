#include "judge/baselines/baselines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_io.hpp"
#include "core/json_file.hpp"
#include "estimation/statistics.hpp"
#include "judge/baselines/layout.hpp"

namespace triptych::judge {
namespace fs = std::filesystem;
using record::Check;
namespace {

struct StoredImage {
  ReferenceHash reference;
  std::map<std::string, std::string> data;  // content hashes, by Layout::data_key
};

template <typename Value>
using ByName = std::map<std::string, Value>;

// Reads {name: value, …}; empty if the file is missing.
template <typename Value, typename Read>
ByName<Value> read_members(const core::JsonNode& node, const Read& read) {
  ByName<Value> result;
  for (const auto& [name, value] : node.members()) result.emplace(name, read(value));
  return result;
}

template <typename Value, typename Read>
ByName<Value> read_table(const fs::path& path, const Read& read) {
  const auto file = core::JsonFile::read(path);
  return file ? read_members<Value>(file->root(), read) : ByName<Value>{};
}

// Reads {"device": …, "configurations": {name: value, …}}. The file must be about the expected
// device.
template <typename Value, typename Read>
ByName<Value> read_device_table(const fs::path& path, std::string_view device, const Read& read) {
  const auto file = core::JsonFile::read(path);
  if (!file) return {};
  const core::JsonNode named = file->root().at("device");
  if (named.text() != device) named.fail(fmt::format("expected the device '{}'", device));
  return read_members<Value>(file->root().at("configurations"), read);
}

std::string read_text(const core::JsonNode& node) {
  return node.text();
}

record::StatisticWorth read_worth(const core::JsonNode& node) {
  try {
    return node.value().get<record::StatisticWorth>();
  } catch (const core::InputError& error) {
    node.fail(error.what());
  }
}

record::Counts read_counts(const core::JsonNode& node) {
  return read_members<std::uint64_t>(node,
                                     [](const core::JsonNode& n) { return n.whole_number(); });
}

Manifest read_manifest(const core::JsonNode& node) {
  Manifest manifest{.plan_hash = node.at("plan_hash").text(),
                    .configurations = node.at("configurations").whole_number(),
                    .files = read_members<std::string>(node.at("files"), read_text)};
  for (const auto& [device, drivers] : node.at("devices").members()) {
    for (const core::JsonNode& driver : drivers.elements()) {
      manifest.devices[device].insert(driver.text());
    }
  }
  manifest.checks = record::checks_of(node.at("checks").text());
  if (!node.has("machines")) return manifest;
  for (const core::JsonNode& machine : node.at("machines").elements()) {
    std::set<std::string>& drivers = manifest.machines.emplace_back();
    for (const core::JsonNode& driver : machine.elements()) drivers.insert(driver.text());
  }
  return manifest;
}

StoredImage read_stored_image(const core::JsonNode& node) {
  const core::JsonNode both = node.at("reference");
  const auto hashes = both.elements();
  if (hashes.size() != 2) both.fail("expected two hashes");
  StoredImage image{{hashes[0].text(), hashes[1].text()}, {}};
  for (const auto& [name, value] : node.members()) {
    if (name.starts_with("data")) image.data.emplace(name, value.text());
  }
  return image;
}

StoredCounters read_counters(const core::JsonNode& node) {
  return read_members<record::Counts>(node, [](const core::JsonNode& by_device) {
    record::Counts counts = read_counts(by_device);
    if (counts.empty()) by_device.fail("expected the value of a device at least");
    return counts;
  });
}

ByName<record::Counts> read_memory(const core::JsonNode& node) {
  return read_members<record::Counts>(node, read_counts);
}

ByName<StoredError> read_errors(const core::JsonNode& node) {
  return read_members<StoredError>(node, [](const core::JsonNode& error) {
    return StoredError{error.at("rmse").number_from_zero(),
                       error.at("arithmetic").number_from_zero()};
  });
}

DriverCost read_cost(const core::JsonNode& node) {
  return {.device = node.at("device").text(),
          .driver_version = node.at("driver_version").text(),
          .counted_by = node.at("counted_by").text(),
          .configurations =
              read_members<StoredCost>(node.at("configurations"), [](const core::JsonNode& cost) {
                return StoredCost{read_counts(cost.at("frame")), read_counts(cost.at("prepare"))};
              })};
}

record::Executable read_executable(const core::JsonNode& node) {
  record::Executable executable;
  for (const auto& [name, value] : node.members()) {
    if (name == "assembly") {
      executable.assembly = value.text();
    } else {
      executable.statistics.emplace(name, value.number_from_zero());
    }
  }
  return executable;
}

DriverCode read_code(const core::JsonNode& node) {
  const auto read_one = [](const core::JsonNode& code) {
    return read_members<record::Executable>(code, read_executable);
  };
  return {.device = node.at("device").text(),
          .driver_version = node.at("driver_version").text(),
          .configurations = read_members<record::Code>(node.at("configurations"), read_one)};
}

StoredTiming read_timing(const core::JsonNode& node) {
  return {node.at("clock").text(), node.at("median_ns").positive_number(),
          node.at("spread").positive_number(), node.at("kernel_hash").text()};
}

template <typename Table>
auto find_optional(const Table& table, const std::string& name) {
  const auto found = table.find(name);
  return found == table.end() ? std::optional<typename Table::mapped_type>{}
                              : std::optional(found->second);
}

// The JSON files of a subfolder, by their names without ending.
std::map<std::string, fs::path> files_in(const fs::path& folder) {
  std::map<std::string, fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.emplace(entry.path().stem(), entry.path());
  }
  return files;
}

bool is_outside(const fs::path& name) {
  return name.is_absolute() || std::find(name.begin(), name.end(), fs::path("..")) != name.end();
}

// The first file that differs from the manifest, and how; empty if there is none.
std::string first_change(const fs::path& folder, const Manifest& manifest) {
  for (const auto& [name, hash] : manifest.files) {
    const fs::path file = folder / name;
    if (is_outside(name)) return name + " is outside the folder";
    if (!fs::is_regular_file(file)) return name + " is gone";
    if (core::content_hash(core::read_file(file)) != hash) return name + " was changed";
  }
  std::set<std::string> others;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (!entry.is_directory() && name != Layout::manifest && !manifest.files.contains(name)) {
      others.insert(name);
    }
  }
  return others.empty() ? std::string() : *others.begin() + " is none of its files";
}

}  // namespace

double log_spread(std::vector<double> times_ns) {
  constexpr double between_processes = 0.005;
  constexpr double normal = 1.4826;
  std::ranges::sort(times_ns);
  std::vector<double> logarithms;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < times_ns.size(); ++i) {
    logarithms.push_back(std::log(times_ns[i]));
    if (i > 0 && times_ns[i] > times_ns[i - 1]) {
      step = std::min(step, logarithms[i] - logarithms[i - 1]);
    }
  }
  if (!std::isfinite(step)) step = 0;
  const double centre = estimation::median(logarithms);
  for (double& value : logarithms) value = std::abs(value - centre);
  return std::max({normal * estimation::median(logarithms), step, between_processes});
}

// What was read so far, by file.
struct Baselines::Cache {
  fs::path folder;
  std::optional<Manifest> manifest;
  std::optional<std::string> problem;
  std::optional<ByName<StoredImage>> images;
  std::optional<ByName<StoredCounters>> counters;
  std::optional<ByName<ByName<record::Counts>>> memory;
  std::optional<ByName<ByName<StoredError>>> errors;
  std::optional<ByName<ByName<std::uint64_t>>> scores;
  std::optional<ByName<DriverCost>> cost;
  std::optional<ByName<DriverCode>> code;
  std::map<fs::path, ByName<record::Counts>> statistics;
  std::map<fs::path, ByName<record::StatisticWorth>> calibrations;
  std::map<fs::path, ByName<StoredTiming>> timings;
  std::optional<std::vector<Waiver>> waivers;
  std::optional<std::vector<Absent>> absent;

  // A whole file of the form {configuration: …}.
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
  // The calibration is in the same file; a driver that was accepted without calibration has none.
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
    problem = std::string(Layout::manifest) + " is gone";
  } else {
    try {
      problem = first_change(folder_, manifest());
    } catch (const core::InputError& error) {  // what a careless merge leaves
      problem = error.what();
    }
    try {
      if (problem.empty()) problem = contradiction();
    } catch (const core::InputError&) {
      // A file with a wrong value is an error, with its line, when a check reads it.
    }
  }
  cache_->problem = std::move(problem);
  return *cache_->problem;
}

// Nothing proves the manifest, which proves the other files. So what it says about them is compared
// with them: a device or driver that the manifest leaves out would count as new, and a check as not
// requested.
std::string Baselines::contradiction() const {
  const Manifest& manifest = this->manifest();
  std::set<std::string> drivers;
  for (const auto& [id, known] : manifest.devices) drivers.insert(known.begin(), known.end());
  const auto lacks = [](const std::string& what) {
    return fmt::format("{} does not name {}", Layout::manifest, what);
  };
  for (const auto& [configuration, counters] : cache_->all_counters()) {
    for (const auto& [counter, values] : counters) {
      for (const auto& [id, value] : values) {
        if (!manifest.devices.contains(id)) return lacks(id + ", which counters.json has");
      }
    }
  }
  for (const char* folder : {Layout::cost_folder, Layout::statistics_folder}) {
    for (const auto& [driver, path] : files_in(folder_ / folder)) {
      if (!drivers.contains(driver)) return lacks(folder + driver + ".json");
    }
  }
  for (const std::set<std::string>& machine : manifest.machines) {
    for (const std::string& driver : machine) {
      if (!drivers.contains(driver)) return lacks("a driver of a machine, " + driver);
    }
  }
  for (const auto& [check, file] : {std::pair{Check::accuracy, Layout::errors},
                                    std::pair{Check::stress, Layout::scores}}) {
    if (fs::exists(folder_ / file) && !manifest.checks.contains(check)) {
      return lacks(fmt::format("the check {}, which {} is of", record::name_of(check), file));
    }
  }
  return {};
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

std::map<std::string, record::Counts> Baselines::memory(const std::string& configuration) const {
  return find_optional(cache_->table(cache_->memory, Layout::memory, read_memory), configuration)
      .value_or(ByName<record::Counts>{});
}

std::map<std::string, StoredError> Baselines::errors(const std::string& configuration) const {
  return find_optional(cache_->table(cache_->errors, Layout::errors, read_errors), configuration)
      .value_or(ByName<StoredError>{});
}

std::map<std::string, std::uint64_t> Baselines::scores(const std::string& configuration) const {
  // The table has the same form as one of counts: names and integers.
  return find_optional(cache_->table(cache_->scores, Layout::scores, read_counts), configuration)
      .value_or(record::Counts{});
}

const std::map<std::string, DriverCost>& Baselines::cost_of_all_drivers() const {
  if (!cache_->cost) {
    cache_->cost.emplace();
    for (const auto& [driver, path] : files_in(folder_ / Layout::cost_folder)) {
      if (const auto file = core::JsonFile::read(path)) {
        cache_->cost->emplace(driver, read_cost(file->root()));
      }
    }
  }
  return *cache_->cost;
}

const DriverCost* Baselines::cost(const record::Device& device) const {
  const auto found = cost_of_all_drivers().find(device.statistics_key());
  return found == cost_of_all_drivers().end() ? nullptr : &found->second;
}

const std::map<std::string, DriverCode>& Baselines::code_of_all_drivers() const {
  if (!cache_->code) {
    cache_->code.emplace();
    for (const auto& [driver, path] : files_in(folder_ / Layout::code_folder)) {
      if (const auto file = core::JsonFile::read(path)) {
        cache_->code->emplace(driver, read_code(file->root()));
      }
    }
  }
  return *cache_->code;
}

const DriverCode* Baselines::code(const record::Device& device) const {
  const auto found = code_of_all_drivers().find(device.statistics_key());
  return found == code_of_all_drivers().end() ? nullptr : &found->second;
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

const std::vector<Absent>& Baselines::absent() const {
  if (!cache_->absent) cache_->absent = read_absent(absent_file());
  return *cache_->absent;
}

const std::vector<Waiver>& Baselines::waivers() const {
  if (!cache_->waivers) cache_->waivers = read_waivers(root_ / "waivers.json");
  return *cache_->waivers;
}

}  // namespace triptych::judge
