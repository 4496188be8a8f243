#pragma once
// What two devices must agree on, for the gate and for comparing in pairs alike.

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "record/statistic_worth.hpp"

namespace triptych::judge {

// Root mean square between any two devices' pictures on default paths, in full scale.
inline constexpr double device_agreement = 1e-4;

// Relative. A threshold on floats may fall the other way on another device for a few samples.
inline constexpr double counters_across_devices = 1e-4;

// Counters of how a technique works, where an API's has its own: OpenCL bins spheres that Vulkan
// and GL draw at once.
[[nodiscard]] constexpr bool is_of_the_api(std::string_view counter) {
  return counter == "bin_entries";
}

// Vulkan and GL leave the rest of the statistics to the implementation.
inline constexpr std::array<std::string_view, 5> portable_statistics{
    "input_assembly_vertices", "input_assembly_primitives", "geometry_primitives",
    "tessellation_control_patches", "compute_invocations"};

// What a statistic is worth by Device::statistics_calibration; only exact ones are compared with
// those of other drivers. Without any calibration the numbers are taken as they are.
[[nodiscard]] record::StatisticWorth worth_of(
    const std::map<std::string, record::StatisticWorth>& calibration, const std::string& statistic);

}  // namespace triptych::judge
