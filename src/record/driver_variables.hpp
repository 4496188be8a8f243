#pragma once
// Environment variables that name the drivers to load, or the folders in which loaders search for
// drivers. A run stores their values as facts about the system. Most of them are missing in
// Device::environment, because they do not change the code that a given driver generates, so they
// must not change the device's key.

#include <array>
#include <map>
#include <string>
#include <string_view>

namespace triptych::record {

struct DriverVariable {
  std::string_view name;
  std::string_view api;  // the only API that is affected; empty: all APIs
};
inline constexpr std::array<DriverVariable, 12> driver_variables{{
    {"GALLIUM_DRIVER", "gl"},
    {"LD_LIBRARY_PATH", ""},
    {"LD_PRELOAD", ""},
    {"LIBGL_DRIVERS_PATH", "gl"},
    {"MESA_LOADER_DRIVER_OVERRIDE", "gl"},
    {"OCL_ICD_FILENAMES", "opencl"},
    {"OCL_ICD_VENDORS", "opencl"},
    {"VK_ADD_DRIVER_FILES", "vulkan"},
    {"VK_DRIVER_FILES", "vulkan"},
    {"VK_ICD_FILENAMES", "vulkan"},
    {"__EGL_VENDOR_LIBRARY_DIRS", "gl"},
    {"__EGL_VENDOR_LIBRARY_FILENAMES", "gl"},
}};

// Returns the variables that affect the API, with the values that they had during a run. `system`
// is Run::system.
[[nodiscard]] inline std::map<std::string, std::string> driver_variables_of(
    const std::map<std::string, std::string>& system, std::string_view api) {
  std::map<std::string, std::string> set;
  for (const DriverVariable& each : driver_variables) {
    if (!each.api.empty() && each.api != api) continue;
    if (const auto found = system.find(std::string(each.name)); found != system.end()) {
      set.insert(*found);
    }
  }
  return set;
}

}  // namespace triptych::record
