#pragma once
// The data of a configuration, loaded and encoded for a device.

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/contract/suite.hpp"
#include "scene/volume.hpp"
#include "suites/volume/stress_cases.hpp"

namespace triptych::volume_suite {

struct LoadedData {
  std::string data;
  std::string window;
  std::string mapping;
  std::string component;
  std::optional<StressScene> stress;  // without its voxels
  scene::VoxelFormat native = scene::VoxelFormat::f32;
  bool fits_halves = false;
  std::shared_ptr<const scene::VoxelGrid> grid;
};

// Chooses the voxel format, given the size of the volume and the format that stores it without
// loss.
using ChooseFormat =
    std::function<scene::VoxelFormat(scene::VoxelFormat native, const std::array<int, 3>& size)>;
using OnNote = std::function<void(const std::string&)>;

// Loads data, and caches the most recent data set, because successive configurations of a plan
// usually share it.
class DataLoader {
 public:
  // `folders` must outlive this object.
  explicit DataLoader(const std::vector<std::filesystem::path>& folders) : folders_(folders) {}

  // Loads the volume. For a stress case, `stress` receives the other parts of its scene.
  [[nodiscard]] scene::Volume read(const measure::Configuration& configuration,
                                   std::optional<StressScene>& stress) const;
  // Loads and encodes the volume. Calls `on_note` with each note of the file reader, which states
  // what the reader guessed or left out. The result is valid until the next call.
  const LoadedData& load(const measure::Configuration& configuration, const ChooseFormat& choose,
                         const OnNote& on_note);

 private:
  const std::vector<std::filesystem::path>& folders_;
  LoadedData loaded_;
};

}  // namespace triptych::volume_suite
