#pragma once
#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "record/record.hpp"

namespace triptych::record {

// The first device of each driver version, API and processor. OpenGL devices of one driver, through
// EGL and through OSMesa, differ only in how they are opened and how their images are read.
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
