#pragma once
// The largest differences that are allowed between two devices, for the gate and for comparisons.

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "record/statistic_worth.hpp"

namespace triptych::judge {

// The largest allowed RMS difference between the images of two devices that use their default
// rendering paths. Full scale is 1.
inline constexpr double device_agreement = 1e-4;

// The allowed relative difference of a counter between two devices. It is not 0, because round-off
// can put a few samples on different sides of a threshold on different devices.
inline constexpr double counters_across_devices = 1e-4;

// Returns whether the value of this counter depends on the API. For example, the same technique
// bins spheres on OpenCL, but draws them directly on Vulkan and OpenGL.
[[nodiscard]] constexpr bool depends_on_api(std::string_view counter) {
  return counter == "bin_entries";
}

// The pipeline statistics that Vulkan and OpenGL define exactly. The values of all other statistics
// depend on the implementation.
inline constexpr std::array<std::string_view, 5> portable_statistics{
    "input_assembly_vertices", "input_assembly_primitives", "geometry_primitives",
    "tessellation_control_patches", "compute_invocations"};

// Returns how exactly a driver counts a statistic, according to Device::statistics_calibration.
// Only exact statistics are compared with those of other drivers. If there is no calibration at
// all, the driver's numbers are assumed to be exact.
[[nodiscard]] record::StatisticWorth worth_of(
    const std::map<std::string, record::StatisticWorth>& calibration, const std::string& statistic);

}  // namespace triptych::judge
