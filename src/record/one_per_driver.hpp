#pragma once
#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "record/record.hpp"

namespace triptych::record {

// Returns the first device for each combination of API, device name, driver and driver version. EGL
// and OSMesa therefore count as one OpenGL driver, because they differ only in how a device is
// opened and how an image is read back.
[[nodiscard]] inline std::vector<Device> one_per_driver(std::span<const Device> devices) {
  const auto driver_of = [](const Device& device) {
    return std::tie(device.api, device.name, device.driver, device.driver_version);
  };
  std::vector<Device> first;
  for (const Device& device : devices) {
    const bool known = std::ranges::any_of(
        first, [&](const Device& other) { return driver_of(other) == driver_of(device); });
    if (!known) first.push_back(device);
  }
  return first;
}

}  // namespace triptych::record
