#pragma once
// What two devices must agree on, both for the gate and for comparisons in pairs.

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "record/statistic_worth.hpp"

namespace triptych::judge {

// The largest root mean square of the difference between the pictures of any two devices on default
// paths, in units of full scale.
inline constexpr double device_agreement = 1e-4;

// Relative difference. For a few samples, a comparison of floats with a threshold may come out
// differently on another device.
inline constexpr double counters_across_devices = 1e-4;

// Counters of how a technique works, where one API works in its own way: OpenCL bins spheres that
// Vulkan and GL draw all at once.
[[nodiscard]] constexpr bool is_of_the_api(std::string_view counter) {
  return counter == "bin_entries";
}

// Vulkan and GL leave the other statistics to the implementation.
inline constexpr std::array<std::string_view, 5> portable_statistics{
    "input_assembly_vertices", "input_assembly_primitives", "geometry_primitives",
    "tessellation_control_patches", "compute_invocations"};

// What a statistic is worth according to Device::statistics_calibration. Only exact ones are
// compared with those of other drivers. Without a calibration, the numbers are taken as they are.
[[nodiscard]] record::StatisticWorth worth_of(
    const std::map<std::string, record::StatisticWorth>& calibration, const std::string& statistic);

}  // namespace triptych::judge
