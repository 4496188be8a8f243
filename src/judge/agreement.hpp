#pragma once
// The agreement that is required of two devices, for the gate and for comparisons.

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "record/statistic_worth.hpp"

namespace triptych::judge {

// The largest allowed RMS difference between the images of two devices that use their default
// paths, in units of full scale.
inline constexpr double device_agreement = 1e-4;

// The allowed relative difference of a counter between two devices. For a few samples, comparing a
// float with a threshold may give another result on another device.
inline constexpr double counters_across_devices = 1e-4;

// Whether techniques count this differently on one API: on OpenCL they bin spheres, which Vulkan
// and GL draw directly.
[[nodiscard]] constexpr bool is_of_the_api(std::string_view counter) {
  return counter == "bin_entries";
}

// The statistics that Vulkan and GL define exactly. The APIs leave all others to the
// implementation.
inline constexpr std::array<std::string_view, 5> portable_statistics{
    "input_assembly_vertices", "input_assembly_primitives", "geometry_primitives",
    "tessellation_control_patches", "compute_invocations"};

// How exactly a driver counts a statistic, from Device::statistics_calibration. Only exact
// statistics are compared with those of other drivers. Without a calibration, the numbers are used
// as they are.
[[nodiscard]] record::StatisticWorth worth_of(
    const std::map<std::string, record::StatisticWorth>& calibration, const std::string& statistic);

}  // namespace triptych::judge
