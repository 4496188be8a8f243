#pragma once
// How far two counts of the same frame of the same program may lie apart, process run against
// process run.

#include <array>
#include <optional>
#include <string_view>

#include "core/glob.hpp"

namespace triptych::judge {

struct CostTolerance {
  std::string_view part;       // "device_code" or "driver"
  std::string_view device;     // glob
  std::string_view technique;  // glob
  double share = 0;            // of the stored frame, device code and driver together
  double own = 0;              // and of the part itself
  double count = 0;            // and instructions, whatever the frame takes
};

// The first that fits holds. All were measured, cold caches against warm ones (docs/cost.md).
// - Device code: the same to the instruction, 238 of 238. Where atomics order the work (`tiles`) a
//   list may be walked in another order.
// - The driver: looks up what it allocated, and finds it sooner or later: 0.007 % of the frame at
//   most. PoCL's threads wait for each other, 2,000 instructions at a time: 0.34 % of a frame of
//   0.5 million, 1.4 % of the smallest (tiles of eight spheres).
// - lavapipe of Mesa 22.3 compiles within every frame of shading=gradient and of tiles with
//   occlusion (8 to 14 million instructions), as it writes uniforms into branches anew. LLVM walks
//   tables in the order of addresses: 0.16 to 0.55 % of the driver's count were seen between two
//   runs. Where nothing is compiled the driver is a hundredth of such a frame, so that a share of
//   its own adds next to nothing.
// - What a process drew before moves the driver's count, by 260 to 1,410 instructions on OpenGL, of
//   lavapipe's `tiles` by 4,800 (1.8 % of it): another technique's change must not be found here,
//   and a part of the plan is compared with what the whole plan counted.
inline constexpr std::array cost_tolerances{
    CostTolerance{"device_code", "*", "tiles", 1e-5},
    CostTolerance{"device_code", "*", "*", 0},
    CostTolerance{"driver", "opencl:pocl*", "*", 3.5e-3, 0, 2000},
    CostTolerance{"driver", "vulkan:lavapipe*", "raycast*", 5e-4, 1e-2, 2000},
    CostTolerance{"driver", "vulkan:lavapipe*", "tiles", 5e-4, 1e-2, 2000},
    CostTolerance{"driver", "*", "*", 5e-4, 0, 2000},
};

// In instructions, as are what is stored of the part and of the frame.
[[nodiscard]] inline double cost_tolerance(std::string_view part, std::string_view device,
                                           std::string_view technique, double stored,
                                           double frame) {
  for (const CostTolerance& each : cost_tolerances) {
    if (each.part == part && core::glob_matches(each.device, device) &&
        core::glob_matches(each.technique, technique)) {
      return each.share * frame + each.own * stored + each.count;
    }
  }
  return 0;
}

// Cache misses of device code; nothing where they do not repeat. Where a buffer begins within a
// line differs from run to run: 0.07 % was the most of volumes, and single misses of some hundred.
// Sprites and tiles touch about as much as the cache holds, so that it moved theirs by 5 %.
[[nodiscard]] inline std::optional<double> misses_tolerance(std::string_view technique,
                                                            double stored) {
  const bool volumes = core::glob_matches("raycast*", technique) || technique == "speed_of_light";
  return volumes ? std::optional(16 + 0.01 * stored) : std::nullopt;
}

}  // namespace triptych::judge
