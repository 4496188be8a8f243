#pragma once
// The platforms and devices that the ICD loader lists.

#include <vector>

#include "backends/opencl/objects.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

struct Found {
  cl::Device device;
  record::Device info;
};

struct Search {
  std::vector<Found> found;
  std::vector<measure::Broken> broken;
};

// Does not throw if a driver fails. A platform or device that fails is listed in `broken`.
[[nodiscard]] Search find_devices();

// Returns "pocl" for "Portable Computing Language", and similar short names for other known
// platforms. For an unknown platform, returns the lower-case letters and digits of its name.
[[nodiscard]] std::string driver_of(std::string_view platform_name);

}  // namespace triptych::opencl_backend
