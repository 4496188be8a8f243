#pragma once
// The names of the files in baselines/<suite>/<plan>/.

#include <filesystem>
#include <string>

#include "core/hash.hpp"
#include "record/record.hpp"

namespace triptych::judge {

struct Layout {
  static constexpr const char* manifest = "manifest.json";
  static constexpr const char* images = "images.json";
  static constexpr const char* counters = "counters.json";
  static constexpr const char* memory = "memory.json";
  static constexpr const char* errors = "accuracy.json";
  static constexpr const char* scores = "score.json";
  static constexpr const char* history = "history.json";
  static constexpr const char* lacking = "lacking.json";
  static constexpr const char* cost_folder = "cost/";
  static constexpr const char* code_folder = "code/";
  static constexpr const char* statistics_folder = "statistics/";

  [[nodiscard]] static std::string image(const std::string& scene) {
    return "images/" + core::content_hash(scene) + ".exr";
  }
  [[nodiscard]] static std::string cost(const record::Device& device) {
    return cost_folder + device.statistics_key() + ".json";
  }
  [[nodiscard]] static std::string code(const record::Device& device) {
    return code_folder + device.statistics_key() + ".json";
  }
  [[nodiscard]] static std::string statistics(const record::Device& device) {
    return statistics_folder + device.statistics_key() + ".json";
  }
  [[nodiscard]] static std::string timings(const record::Device& device) {
    return "timings/" + device.key_hash() + ".json";
  }
  // Returns the key of the data's content hash in an entry of images.json. There is one key for
  // each voxel format, because the hash depends on the format and devices prefer different formats.
  [[nodiscard]] static std::string data_key(const record::Record& record) {
    const auto voxel = record.factors.find("voxel");
    return voxel == record.factors.end() ? "data" : "data_" + voxel->second;
  }
  // Returns the temporary folder to which `accept` writes before it replaces `folder`. It remains
  // only if `accept` was killed.
  [[nodiscard]] static std::filesystem::path staging_folder(const std::filesystem::path& folder) {
    return folder.parent_path() / ("." + folder.filename().string() + ".accepting");
  }
};

}  // namespace triptych::judge
