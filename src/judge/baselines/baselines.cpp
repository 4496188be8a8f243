#include "judge/baselines/baselines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_io.hpp"
#include "judge/baselines/json_file.hpp"
#include "judge/baselines/layout.hpp"

namespace triptych::judge {
namespace {

constexpr std::size_t least_runs = 5;  // fewer stored runs decide nothing

struct StoredImage {
  std::string file;
  std::string hash;
  // Content hashes of the scene's data by Layout::data_key; none in baselines from before they were
  // kept.
  std::map<std::string, std::string> data;
};

template <typename Value>
using ByName = std::map<std::string, Value>;

// {name: value, …}; empty when the file is missing.
template <typename Value, typename Read>
ByName<Value> read_members(const JsonNode& node, const Read& read) {
  ByName<Value> result;
  for (const auto& [name, value] : node.members()) result.emplace(name, read(value));
  return result;
}

template <typename Value, typename Read>
ByName<Value> read_table(const std::filesystem::path& path, const Read& read) {
  const auto file = JsonFile::read(path);
  return file ? read_members<Value>(file->root(), read) : ByName<Value>{};
}

// {"device": …, "configurations": {name: value, …}}. A file that was renamed must not speak for
// another device.
template <typename Value, typename Read>
ByName<Value> read_device_table(const std::filesystem::path& path, std::string_view device,
                                const Read& read) {
  const auto file = JsonFile::read(path);
  if (!file) return {};
  const JsonNode named = file->root().at("device");
  if (named.text() != device) named.fail(fmt::format("expected the device '{}'", device));
  return read_members<Value>(file->root().at("configurations"), read);
}

record::Counts read_counts(const JsonNode& node) {
  return read_members<std::uint64_t>(node, [](const JsonNode& n) { return n.whole_number(); });
}

StoredImage read_stored_image(const JsonNode& node) {
  StoredImage image{node.at("file").text(), node.at("hash").text(), {}};
  for (const auto& [name, value] : node.members()) {
    if (name.starts_with("data")) image.data.emplace(name, value.text());
  }
  return image;
}

StoredCounters read_counters(const JsonNode& node) {
  return read_members<record::Counts>(node, [](const JsonNode& by_device) {
    record::Counts counts = read_counts(by_device);
    if (counts.empty()) by_device.fail("expected the value of a device at least");
    return counts;
  });
}

std::map<std::string, StoredError> read_errors(const JsonNode& node) {
  return read_members<StoredError>(node, [](const JsonNode& error) {
    return StoredError{error.at("rmse").number_from_zero(),
                       error.at("arithmetic").number_from_zero()};
  });
}

StoredBits read_bits(const JsonNode& node) {
  return {node.at("image").text(), node.at("kernel_hash").text()};
}

std::vector<StoredTiming> read_timings(const JsonNode& node) {
  std::vector<StoredTiming> result;
  for (const JsonNode& entry : node.elements()) {
    result.push_back({entry.at("run").text(), entry.at("median_ns").positive_number(),
                      entry.at("clock").text(), entry.at("kernel_hash").text(),
                      entry.has("median_wall_ns")
                          ? std::optional(entry.at("median_wall_ns").positive_number())
                          : std::nullopt});
  }
  if (result.empty()) node.fail("expected a run at least");
  return result;
}

// Device::key() begins with the id and the driver.
std::string id_of_key(const std::string& key) {
  return key.substr(0, key.find("; driver "));
}

bool is_iso_date(std::string_view text) {
  constexpr std::string_view shape = "dddd-dd-dd";
  return text.size() == shape.size() && std::ranges::equal(text, shape, [](char c, char s) {
           return s == 'd' ? c >= '0' && c <= '9' : c == s;
         });
}

std::vector<Waiver> read_waivers(const std::filesystem::path& path) {
  std::vector<Waiver> result;
  const auto file = JsonFile::read(path);
  if (!file) return result;
  for (const JsonNode& entry : file->root().elements()) {
    Waiver waiver{entry.at("device").text(), entry.at("test").text(), entry.at("reason").text(),
                  entry.at("expiry").text()};
    if (waiver.reason.find_first_not_of(" \t") == std::string::npos) {
      entry.at("reason").fail("expected a reason");
    }
    if (!is_iso_date(waiver.expiry)) entry.at("expiry").fail("expected a date as YYYY-MM-DD");
    result.push_back(std::move(waiver));
  }
  return result;
}

// What history.json tells of all that was ever accepted.
struct History {
  std::set<std::string> devices;  // keys
  std::set<std::string> files;    // within the plan's folder
};

History read_history(const std::filesystem::path& path) {
  History result;
  const auto file = JsonFile::read(path);
  if (!file) return result;
  for (const JsonNode& entry : file->root().elements()) {
    for (const JsonNode& device : entry.at("devices").elements()) {
      result.devices.insert(device.text());
    }
    // "FILE: 3 changed, 0 added, 0 removed"
    for (const JsonNode& change : entry.at("changes").elements()) {
      const std::string line = change.text();
      result.files.insert(line.substr(0, line.find(": ")));
    }
  }
  return result;
}

template <typename Table>
auto find_optional(const Table& table, const std::string& name) {
  const auto found = table.find(name);
  return found == table.end() ? std::optional<typename Table::mapped_type>{}
                              : std::optional(found->second);
}

}  // namespace

std::string_view common_clock(const record::Record& record, std::span<const StoredTiming> stored) {
  const auto runs_by = [&](std::string_view clock) {
    return std::ranges::count_if(
        stored, [&](const StoredTiming& timing) { return timing.median_by(clock).has_value(); });
  };
  const auto own = runs_by(record.clock());
  const bool is_enough = own >= static_cast<std::ptrdiff_t>(least_runs);
  if (is_enough || record.wall_ns.empty()) return record.clock();
  return runs_by("wall") > own ? "wall" : record.clock();
}

// What was read so far, by file.
struct Baselines::Cache {
  Layout layout;
  std::optional<ByName<StoredImage>> images;
  std::optional<ByName<StoredCounters>> counters;
  std::optional<ByName<std::map<std::string, StoredError>>> errors;
  std::optional<ByName<ByName<std::uint64_t>>> scores;
  std::map<std::filesystem::path, ByName<StoredBits>> bits;
  std::map<std::filesystem::path, ByName<record::Counts>> statistics;
  std::map<std::filesystem::path, ByName<std::string>> dialects;
  std::map<std::filesystem::path, ByName<std::vector<StoredTiming>>> timings;
  std::optional<std::vector<Waiver>> waivers;
  std::optional<History> history;

  const ByName<StoredCounters>& all_counters() {
    if (!counters) counters = read_table<StoredCounters>(layout.counters(), read_counters);
    return *counters;
  }
  const History& all_history() {
    if (!history) history = read_history(layout.history());
    return *history;
  }
  // The history tells of the file, and it is gone.
  bool lost(const std::filesystem::path& file) {
    const std::string name = file.lexically_relative(layout.folder).generic_string();
    return all_history().files.contains(name) && !std::filesystem::exists(file);
  }
  // The dialect lies in the same file; one that was accepted without has none.
  const ByName<std::string>& dialect_of(const std::filesystem::path& path) {
    const auto known = dialects.find(path);
    if (known != dialects.end()) return known->second;
    ByName<std::string> dialect;
    if (const auto file = JsonFile::read(path); file && file->value().contains("dialect")) {
      dialect = read_members<std::string>(file->root().at("dialect"),
                                          [](const JsonNode& n) { return n.text(); });
    }
    return dialects.emplace(path, std::move(dialect)).first->second;
  }
  const ByName<StoredImage>& stored_images() {
    if (!images) images = read_table<StoredImage>(layout.images(), read_stored_image);
    return *images;
  }
  const ByName<record::Counts>& statistics_of(const std::filesystem::path& path) {
    const auto known = statistics.find(path);
    if (known != statistics.end()) return known->second;
    return statistics
        .emplace(path, read_device_table<record::Counts>(path, path.stem().string(), read_counts))
        .first->second;
  }
};

Baselines::Baselines(std::filesystem::path root, std::string_view plan)
    : root_(std::move(root)), folder_(root_ / plan), cache_(std::make_shared<Cache>()) {
  cache_->layout.folder = folder_;
}

bool Baselines::present() const {
  return std::filesystem::is_directory(folder_);
}

std::string Baselines::data_hash(const record::Record& record) const {
  const StoredImage stored =
      find_optional(cache_->stored_images(), record.scene).value_or(StoredImage{});
  return find_optional(stored.data, Layout::data_key(record)).value_or(std::string{});
}

std::optional<core::Image> Baselines::image(const std::string& scene) const {
  const auto stored = find_optional(cache_->stored_images(), scene);
  if (!stored) return std::nullopt;
  const auto path = cache_->layout.image_folder() / stored->file;
  if (!std::filesystem::exists(path)) return std::nullopt;
  const auto bytes = core::read_file(path);
  if (core::content_hash(bytes) != stored->hash) {
    throw core::InputError({path.string()},
                           "not the image that images.json names; restore it or accept anew");
  }
  return core::decode_exr(bytes);
}

std::optional<StoredCounters> Baselines::counters(const std::string& configuration) const {
  return find_optional(cache_->all_counters(), configuration);
}

std::map<std::string, StoredError> Baselines::errors(const std::string& configuration) const {
  if (!cache_->errors) {
    cache_->errors =
        read_table<std::map<std::string, StoredError>>(cache_->layout.errors(), read_errors);
  }
  return find_optional(*cache_->errors, configuration)
      .value_or(std::map<std::string, StoredError>{});
}

std::map<std::string, std::uint64_t> Baselines::scores(const std::string& configuration) const {
  if (!cache_->scores) {
    // The same shape as counts: names and whole numbers.
    cache_->scores = read_table<record::Counts>(cache_->layout.scores(), read_counts);
  }
  return find_optional(*cache_->scores, configuration).value_or(record::Counts{});
}

std::optional<StoredBits> Baselines::bits(const record::Device& device,
                                          const std::string& configuration) const {
  const auto path = cache_->layout.bits(device);
  auto known = cache_->bits.find(path);
  if (known == cache_->bits.end()) {
    known = cache_->bits.emplace(path, read_device_table<StoredBits>(path, device.key(), read_bits))
                .first;
  }
  return find_optional(known->second, configuration);
}

bool Baselines::has_statistics(const record::Device& device) const {
  return !cache_->statistics_of(cache_->layout.statistics(device)).empty();
}

std::optional<record::Counts> Baselines::statistics(const record::Device& device,
                                                    const std::string& configuration) const {
  return find_optional(cache_->statistics_of(cache_->layout.statistics(device)), configuration);
}

std::map<std::string, record::Counts> Baselines::statistics_of_all_drivers(
    const std::string& configuration) const {
  std::map<std::string, record::Counts> result;
  const auto folder = cache_->layout.statistics_folder();
  if (!std::filesystem::is_directory(folder)) return result;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    const auto counts = find_optional(cache_->statistics_of(entry.path()), configuration);
    if (counts) result.emplace(entry.path().stem().string(), *counts);
  }
  return result;
}

std::map<std::string, std::string> Baselines::statistics_dialect(const std::string& driver) const {
  return cache_->dialect_of(cache_->layout.statistics_folder() / (driver + ".json"));
}

std::vector<StoredTiming> Baselines::timings(const record::Device& device,
                                             const std::string& configuration) const {
  const auto path = cache_->layout.timings(device);
  auto known = cache_->timings.find(path);
  if (known == cache_->timings.end()) {
    known = cache_->timings
                .emplace(path, read_device_table<std::vector<StoredTiming>>(path, device.key(),
                                                                            read_timings))
                .first;
  }
  return find_optional(known->second, configuration).value_or(std::vector<StoredTiming>{});
}

std::vector<StoredDevice> Baselines::timings_of_all_devices() const {
  std::vector<StoredDevice> result;
  const auto folder = cache_->layout.timings_folder();
  if (!std::filesystem::is_directory(folder)) return result;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    const auto file = JsonFile::read(entry.path());
    if (!file) continue;
    StoredDevice device;
    device.key = file->root().at("device").text();
    device.id = id_of_key(device.key);
    device.timings =
        read_members<std::vector<StoredTiming>>(file->root().at("configurations"), read_timings);
    result.push_back(std::move(device));
  }
  std::ranges::sort(result, {}, &StoredDevice::key);
  return result;
}

bool Baselines::accepted_before(const record::Device& device) const {
  return cache_->all_history().devices.contains(device.key());
}

bool Baselines::lost_bits(const record::Device& device) const {
  return cache_->lost(cache_->layout.bits(device));
}

bool Baselines::lost_timings(const record::Device& device) const {
  return cache_->lost(cache_->layout.timings(device));
}

std::vector<std::string> Baselines::configurations() const {
  std::vector<std::string> result;
  for (const auto& [configuration, counters] : cache_->all_counters()) {
    result.push_back(configuration);
  }
  return result;
}

const std::vector<Waiver>& Baselines::waivers() const {
  if (!cache_->waivers) cache_->waivers = read_waivers(root_ / "waivers.json");
  return *cache_->waivers;
}

}  // namespace triptych::judge
