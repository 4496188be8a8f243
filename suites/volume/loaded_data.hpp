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
#include "scene/transfer_function.hpp"
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
  std::array<double, 2> used{0, 1};  // see scene::Volume::used
  std::shared_ptr<const scene::VoxelGrid> grid;

  // Returns scene::empty_image_note() for these data. It is empty for a stress case, because some
  // stress cases have an empty image on purpose.
  [[nodiscard]] std::string empty_image_note(const scene::TransferFunction& function) const;
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
  // Returns lines that describe the volume, with the notes that `load` would report.
  [[nodiscard]] std::vector<std::string> describe(
      const measure::Configuration& configuration) const;
  // Loads and encodes the volume. Calls `on_note` with each note, such as that the file reader
  // guessed a value, or that the window misses nearly all values. The result is valid until the
  // next call.
  const LoadedData& load(const measure::Configuration& configuration, const ChooseFormat& choose,
                         const OnNote& on_note);

 private:
  const std::vector<std::filesystem::path>& folders_;
  LoadedData loaded_;
};

}  // namespace triptych::volume_suite
