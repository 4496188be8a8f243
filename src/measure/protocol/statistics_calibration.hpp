#pragma once
// Determines how exactly a driver counts pipeline statistics. Vulkan and GL leave most of these
// numbers to the implementation, and drivers differ. When a device is opened, scenes with known
// numbers are therefore drawn, and each statistic gets a verdict. Statistics of two drivers are
// compared only if both count exactly (judge/gate/check_statistics.cpp).

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/backend.hpp"
#include "technique/catalogue.hpp"

namespace triptych::measure {

// A calibration scene, and the numbers that a driver reports if it counts exactly.
struct CalibrationScene {
  std::string name;  // for display, such as "one quad over 66×50 pixels"
  Work work;
  record::Counts expected;
  // Whether the expected number of fragments is taken from Triptych's counter `fragments`.
  bool counts_fragments = false;
};

// Returns the scenes for one kind of work. Widths and heights of drawn images are not multiples of
// 4, so that a driver that counts whole blocks of pixels is detected.
[[nodiscard]] std::vector<CalibrationScene> calibration_scenes(technique::Work kind);

// A statistic in a scene, as it was read in two frames, `first` and `again`. Each is nullopt if the
// device reported other statistics of the frame but not this one.
struct CalibrationReading {
  std::string scene;
  std::uint64_t expected = 0;
  std::optional<std::uint64_t> first;
  std::optional<std::uint64_t> again;
  record::Counts ours = {};  // Triptych's counters for the scene
};

// Returns the verdict on the statistic. `proportional` requires at least two scenes, and `inflated`
// requires that no reading is too low. There must be at least one reading, and expected > 0 in
// each.
[[nodiscard]] record::StatisticWorth calibration_verdict(
    const std::vector<CalibrationReading>& readings);

// Returns the verdict on every statistic of the scenes that the device can draw. The result is
// empty if the device reports no statistics at all (OpenCL). If the API reports an error while a
// scene is drawn, its statistics are `unknown`. Statistics that are all 0 or never become available
// are added to `faults`. Throws DeviceLost.
[[nodiscard]] std::map<std::string, record::StatisticWorth> calibrate_statistics(
    Device& device, technique::Work kind, std::vector<record::DeviceFault>* faults = nullptr);

}  // namespace triptych::measure
