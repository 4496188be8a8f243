#pragma once
// What a driver's pipeline statistics are worth. Vulkan and GL leave most of these numbers to the
// implementation, and drivers use the freedom; so scenes of which every number is known are drawn
// once when a device is opened, and each statistic gets a verdict. Only what both drivers count
// exactly is ever compared between them (judge/gate/check_statistics.cpp).

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/backend.hpp"
#include "technique/catalogue.hpp"

namespace triptych::measure {

// A scene to calibrate with, and what a driver that counts exactly says of it.
struct CalibrationScene {
  std::string name;  // for people: "one quad over 66×50 pixels"
  Work work;
  record::Counts expected;
  // Whether the fragments are to be learnt from a counters frame (our own counter `fragments`).
  bool counts_fragments = false;
};

// Those of one kind of work. Widths and heights of what is drawn are no multiples of 4: a driver
// that counts whole stamps of pixels shows.
[[nodiscard]] std::vector<CalibrationScene> calibration_scenes(technique::Work kind);

// One statistic in one scene: `first` in one frame, `again` in the next; nothing where the device
// told other statistics of that frame but not this one.
struct CalibrationReading {
  std::string scene;
  std::uint64_t expected = 0;
  std::optional<std::uint64_t> first;
  std::optional<std::uint64_t> again;
  record::Counts ours = {};  // our own counters of the scene
};

// What the statistic is worth; `proportional` takes at least two scenes, and `inflated` is never
// too low. Precondition: at least one reading, and expected > 0 in each.
[[nodiscard]] record::StatisticWorth calibration_verdict(
    const std::vector<CalibrationReading>& readings);

// Statistic → verdict, for every statistic of the scenes that the device can draw. Empty for a
// device that tells no statistics of any of them (OpenCL). An error of the API while a scene is
// drawn makes the statistics of that scene `unknown`. Statistics that are all 0 or never become
// available are added to `faults`. Throws DeviceLost.
[[nodiscard]] std::map<std::string, record::StatisticWorth> calibrate_statistics(
    Device& device, technique::Work kind, std::vector<record::DeviceFault>* faults = nullptr);

}  // namespace triptych::measure
