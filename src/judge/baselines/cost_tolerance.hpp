#pragma once
// How far two counts of the same frame of the same program may lie apart, process run against
// process run.

#include <array>
#include <string_view>

#include "core/glob.hpp"

namespace triptych::judge {

struct CostTolerance {
  std::string_view part;       // "device_code" or "driver"
  std::string_view device;     // glob
  std::string_view technique;  // glob
  double share = 0;            // of the stored frame, device code and driver together
};

// The first that fits holds. All were measured, cold caches against warm ones (docs/cost.md).
// - Device code: the same to the instruction, 85 of 85. Where atomics order the work (`tiles`) a
//   list may be walked in another order.
// - The driver: looks up what it allocated, and finds it sooner or later: 0.034 % of the frame at
//   most on Mesa. PoCL's threads wait for each other, 2,000 instructions at a time, which is 0.34 %
//   of the smallest frame (tiles, 0.5 million).
inline constexpr std::array cost_tolerances{
    CostTolerance{"device_code", "*", "tiles", 1e-5},
    CostTolerance{"device_code", "*", "*", 0},
    CostTolerance{"driver", "opencl:pocl*", "*", 3.5e-3},
    CostTolerance{"driver", "*", "*", 5e-4},
};

[[nodiscard]] inline double cost_tolerance(std::string_view part, std::string_view device,
                                           std::string_view technique) {
  for (const CostTolerance& each : cost_tolerances) {
    if (each.part == part && core::glob_matches(each.device, device) &&
        core::glob_matches(each.technique, technique)) {
      return each.share;
    }
  }
  return 0;
}

}  // namespace triptych::judge
