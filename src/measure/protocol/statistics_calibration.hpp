#pragma once
// Determines how accurately a driver counts pipeline statistics. Vulkan and OpenGL leave most of
// these counts to the implementation, and drivers differ. Therefore scenes with known counts are
// drawn when a device is opened, and each statistic gets a verdict. Statistics of two drivers are
// compared only if both drivers count exactly (judge/gate/check_statistics.cpp).

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/backend.hpp"
#include "technique/catalogue.hpp"

namespace triptych::measure {

// A calibration scene, and the counts that a driver reports if it counts exactly.
struct CalibrationScene {
  std::string name;  // for display, such as "100 small sprites of quad_screen"
  Work work;
  record::Counts expected;
  // Whether Triptych's counter `fragments` provides the expected number of fragments.
  bool counts_fragments = false;
};

// Returns the scenes for one kind of work. The widths and heights of drawn images are not multiples
// of 4, so that a driver that counts complete blocks of pixels is detected.
[[nodiscard]] std::vector<CalibrationScene> calibration_scenes(technique::Work kind);

// The values of a statistic that the device reported for two frames of a scene, `first` and
// `second`. A value is nullopt if the device reported other statistics for the frame, but not this
// one.
struct CalibrationReading {
  std::string scene;
  std::uint64_t expected = 0;
  std::optional<std::uint64_t> first;
  std::optional<std::uint64_t> second;
  record::Counts counters = {};  // Triptych's counters for the scene
};

// Returns the verdict on a statistic. The verdict `proportional` is possible only with readings of
// at least two scenes, and the verdict `inflated` only if no reading is too low. There must be at
// least one reading, and `expected` must be greater than 0 in each reading.
[[nodiscard]] record::StatisticWorth calibration_verdict(
    const std::vector<CalibrationReading>& readings);

// Returns the verdicts on all statistics in the scenes that the device can draw. The result is
// empty if the device reports no statistics at all (OpenCL). If the API reports an error while a
// scene is drawn, the statistics of that scene are `unknown`. A device fault is added to `faults`
// if all statistics are 0 or if they never become available. Throws DeviceLost.
[[nodiscard]] std::map<std::string, record::StatisticWorth> calibrate_statistics(
    Device& device, technique::Work kind, std::vector<record::DeviceFault>* faults = nullptr);

}  // namespace triptych::measure
