#pragma once
// How closely two devices must agree, for the gate and for comparisons.

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "record/statistic_worth.hpp"

namespace triptych::judge {

// The largest allowed RMS difference between the images of two devices that use their default
// rendering paths. Full scale is 1.
inline constexpr double device_agreement = 1e-4;

// The allowed relative difference of a counter between two devices. For a few samples, a float that
// is compared with a threshold may fall on different sides of it on different devices.
inline constexpr double counters_across_devices = 1e-4;

// Whether the value of this counter depends on the API. Techniques bin spheres on OpenCL, but draw
// them directly on Vulkan and OpenGL.
[[nodiscard]] constexpr bool is_of_the_api(std::string_view counter) {
  return counter == "bin_entries";
}

// The statistics that Vulkan and GL define exactly. The APIs leave all others to the
// implementation.
inline constexpr std::array<std::string_view, 5> portable_statistics{
    "input_assembly_vertices", "input_assembly_primitives", "geometry_primitives",
    "tessellation_control_patches", "compute_invocations"};

// Looks up in Device::statistics_calibration how exactly a driver counts a statistic. Only exact
// statistics are compared with those of other drivers. If there is no calibration at all, the
// driver's numbers are assumed to be exact.
[[nodiscard]] record::StatisticWorth worth_of(
    const std::map<std::string, record::StatisticWorth>& calibration, const std::string& statistic);

}  // namespace triptych::judge
