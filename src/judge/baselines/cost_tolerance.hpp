#pragma once
// The allowed difference of two counts of the same frame by the same program in two processes.

#include <array>
#include <optional>
#include <string_view>

#include "core/glob.hpp"

namespace triptych::judge {

struct CostTolerance {
  std::string_view part;       // "device_code" or "driver"
  std::string_view device;     // glob
  std::string_view technique;  // glob
  double share = 0;            // share of the stored frame, device code and driver together
  double own = 0;              // plus this share of the part's own count
  double count = 0;            // plus this many instructions, for a frame of any size
};

// The first entry that matches is used. All were measured by comparing cold caches with warm ones
// (docs/cost.md).
//   - The counts of device code were identical in 238 of 238 configurations. Where atomics
//   determine
//     the order of the work (`tiles`), a list may be walked in another order.
//   - The driver looks up what it has allocated and finds it after more or fewer steps: at most
//     0.007 % of the frame. PoCL's threads wait for each other, 2,000 instructions at a time. That
//     is 0.34 % of a frame of 0.5 million instructions and 1.4 % of the smallest frame (tiles of
//     eight spheres).
//   - lavapipe of Mesa 22.3 compiles code within every frame of shading=gradient and of tiles with
//     occlusion (8 to 14 million instructions), because it writes the values of uniforms into
//     branches again. LLVM walks tables in the order of addresses: between two runs, the driver's
//     count differed by 0.16 to 0.55 %. Where nothing is compiled, the driver is a hundredth of
//     such a frame, so that this share of its own adds next to nothing.
//   - What a process drew before changes the driver's count: by 260 to 1,410 instructions on
//     OpenGL, and by 4,800 in lavapipe's `tiles` (1.8 % of it). The check of one technique must not
//     report the change of another, and a part of the plan is compared with what the whole plan
//     counted.
inline constexpr std::array cost_tolerances{
    CostTolerance{"device_code", "*", "tiles", 1e-5},
    CostTolerance{"device_code", "*", "*", 0},
    CostTolerance{"driver", "opencl:pocl*", "*", 3.5e-3, 0, 2000},
    CostTolerance{"driver", "vulkan:lavapipe*", "raycast*", 5e-4, 1e-2, 2000},
    CostTolerance{"driver", "vulkan:lavapipe*", "tiles", 5e-4, 1e-2, 2000},
    CostTolerance{"driver", "*", "*", 5e-4, 0, 2000},
};

// Returns the tolerance in instructions. `stored` is the stored count of the part, and `frame` that
// of the frame.
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

// The techniques whose cache misses repeat. A buffer begins at another position within a cache line
// in each run. This changed the misses of volumes by at most 0.07 %, or by single misses if there
// are only about a hundred. Sprites and tiles use about as much memory as the cache holds, so that
// their misses changed by 5 %.
inline constexpr std::array<std::string_view, 2> techniques_with_stable_misses{"raycast*",
                                                                               "speed_of_light"};

// The tolerance for cache misses of device code; empty if they do not repeat.
[[nodiscard]] inline std::optional<double> misses_tolerance(std::string_view technique,
                                                            double stored) {
  for (const std::string_view each : techniques_with_stable_misses) {
    if (core::glob_matches(each, technique)) return 16 + 0.01 * stored;
  }
  return std::nullopt;
}

}  // namespace triptych::judge
