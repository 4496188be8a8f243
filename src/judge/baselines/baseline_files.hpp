#pragma once
// Reads the files that judge/baselines/baselines.hpp describes. For a file with invalid content,
// these functions throw InputError with file and line. Only the class Baselines uses them.

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/json_file.hpp"
#include "judge/baselines/baselines.hpp"

namespace triptych::judge {

struct StoredImage {
  ReferenceHash reference;
  std::map<std::string, std::string> data;  // content hashes, by Layout::data_key
};

template <typename Value>
using ByName = std::map<std::string, Value>;

// Reads an object {name: value, …}.
template <typename Value, typename Read>
ByName<Value> read_members(const core::JsonNode& node, const Read& read) {
  ByName<Value> result;
  for (const auto& [name, value] : node.members()) result.emplace(name, read(value));
  return result;
}

// Reads a file of the form {name: value, …}. Returns an empty table if the file is missing.
template <typename Value, typename Read>
ByName<Value> read_table(const std::filesystem::path& path, const Read& read) {
  const auto file = core::JsonFile::read(path);
  return file ? read_members<Value>(file->root(), read) : ByName<Value>{};
}

// Reads a file of the form {"device": …, "configurations": {name: value, …}}. Throws InputError if
// the file names another device. Returns an empty table if the file is missing.
template <typename Value, typename Read>
ByName<Value> read_device_table(const std::filesystem::path& path, std::string_view device,
                                const Read& read) {
  const auto file = core::JsonFile::read(path);
  if (!file) return {};
  const core::JsonNode device_node = file->root().at("device");
  if (device_node.text() != device) {
    device_node.fail(fmt::format("expected the device '{}'", device));
  }
  return read_members<Value>(file->root().at("configurations"), read);
}

[[nodiscard]] record::StatisticWorth read_worth(const core::JsonNode& node);
[[nodiscard]] record::Counts read_counts(const core::JsonNode& node);
[[nodiscard]] std::set<std::string> read_names(const core::JsonNode& node);
[[nodiscard]] Manifest read_manifest(const core::JsonNode& node);
[[nodiscard]] StoredImage read_stored_image(const core::JsonNode& node);
[[nodiscard]] StoredCounters read_counters(const core::JsonNode& node);
[[nodiscard]] ByName<record::Counts> read_memory(const core::JsonNode& node);
[[nodiscard]] ByName<StoredError> read_errors(const core::JsonNode& node);
[[nodiscard]] DriverCost read_cost(const core::JsonNode& node);
[[nodiscard]] DriverCode read_code(const core::JsonNode& node);
[[nodiscard]] StoredTiming read_timing(const core::JsonNode& node);

// Returns the paths of the JSON files in a folder. The keys are the file names without the
// extension.
[[nodiscard]] std::map<std::string, std::filesystem::path> files_in(
    const std::filesystem::path& folder);
// Describes the first file that does not match the manifest. Returns "" if all files match.
[[nodiscard]] std::string first_change(const std::filesystem::path& folder,
                                       const Manifest& manifest);

}  // namespace triptych::judge
