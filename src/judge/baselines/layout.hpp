#pragma once
// Where each baseline lies within baselines/<suite>/<plan>/, for the reader and the writer alike.

#include <filesystem>
#include <string>

#include "core/hash.hpp"
#include "record/record.hpp"

namespace triptych::judge {

struct Layout {
  std::filesystem::path folder;

  [[nodiscard]] std::filesystem::path images() const { return folder / "images.json"; }
  [[nodiscard]] std::filesystem::path image_folder() const { return folder / "images"; }
  [[nodiscard]] static std::string image_name(const std::string& scene) {
    return core::content_hash(scene) + ".exr";
  }
  // What an image's entry calls the content hash of its data. The same data has one per voxel
  // format, and devices prefer different formats.
  [[nodiscard]] static std::string data_key(const record::Record& record) {
    const auto voxel = record.factors.find("voxel");
    return voxel == record.factors.end() ? "data" : "data_" + voxel->second;
  }
  [[nodiscard]] std::filesystem::path counters() const { return folder / "counters.json"; }
  [[nodiscard]] std::filesystem::path errors() const { return folder / "accuracy.json"; }
  [[nodiscard]] std::filesystem::path scores() const { return folder / "score.json"; }
  [[nodiscard]] std::filesystem::path bits(const record::Device& device) const {
    return folder / "bits" / (device.key_hash() + ".json");
  }
  [[nodiscard]] std::filesystem::path statistics_folder() const { return folder / "statistics"; }
  [[nodiscard]] std::filesystem::path statistics(const record::Device& device) const {
    return statistics_folder() / (device.statistics_key() + ".json");
  }
  [[nodiscard]] std::filesystem::path timings_folder() const { return folder / "timings"; }
  [[nodiscard]] std::filesystem::path timings(const record::Device& device) const {
    return timings_folder() / (device.key_hash() + ".json");
  }
  [[nodiscard]] std::filesystem::path history() const { return folder / "history.json"; }
};

}  // namespace triptych::judge
