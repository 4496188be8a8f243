#pragma once
// The names of the files within baselines/<suite>/<plan>/, for the reader and the writer alike.

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
  // What an image's entry calls the content hash of its data. The same data has one per voxel
  // format, and devices prefer different formats.
  [[nodiscard]] static std::string data_key(const record::Record& record) {
    const auto voxel = record.factors.find("voxel");
    return voxel == record.factors.end() ? "data" : "data_" + voxel->second;
  }
  // Where `accept` writes before it takes the folder's place; left behind only by a kill.
  [[nodiscard]] static std::filesystem::path aside(const std::filesystem::path& folder) {
    return folder.parent_path() / ("." + folder.filename().string() + ".accepting");
  }
};

}  // namespace triptych::judge
