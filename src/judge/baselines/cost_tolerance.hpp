#pragma once
// Tolerances for instruction counts: how much the counts of the same frame may differ between two
// processes of the same program.

#include <array>
#include <optional>
#include <string_view>

#include "core/glob.hpp"

namespace triptych::judge {

struct CostTolerance {
  std::string_view part;       // "device_code" or "driver"
  std::string_view device;     // glob
  std::string_view technique;  // glob
  double frame_share = 0;      // share of the whole frame's stored count (device code and driver)
  double part_share = 0;       // plus this share of the stored count of this part alone
  double count = 0;            // plus this many instructions, regardless of the size of the frame
};

// The first entry that matches is used. The tolerances were measured by comparing runs with cold
// and warm caches (docs/cost.md).
//   - Device code: the counts were identical in all 238 configurations. However, if atomics
//     determine the order of the work (`tiles`), a list may be traversed in a different order.
//   - All drivers: the number of steps in which a driver looks up its memory allocations depends on
//     their addresses. This changes the count by at most 0.007 % of the frame.
//   - PoCL: its threads wait for each other in steps of 2,000 instructions. That is 0.34 % of a
//     frame with 0.5 million instructions, and 1.4 % of the smallest frame (`tiles` with eight
//     spheres).
//   - lavapipe in Mesa 22.3 compiles code in every frame of shading=gradient and of `tiles` with
//     occlusion culling (8 to 14 million instructions), because it compiles the values of uniforms
//     into the code and therefore has to compile again. LLVM iterates over tables in the order of
//     addresses, so the driver's count differed by 0.16 to 0.55 % between two runs. In frames in
//     which nothing is compiled, the driver executes only a hundredth of that number of
//     instructions, so `part_share` adds next to nothing.
//   - All drivers: the count depends on what the process drew before. The difference is 260 to
//     1,410 instructions on OpenGL, and 4,800 instructions for `tiles` on lavapipe (1.8 % of the
//     driver's count). This must be tolerated, because a change to one technique must not affect
//     the result of another technique, and because a part of a plan is compared with a run of the
//     whole plan.
inline constexpr std::array cost_tolerances{
    CostTolerance{"device_code", "*", "tiles", 1e-5},
    CostTolerance{"device_code", "*", "*", 0},
    CostTolerance{"driver", "opencl:pocl*", "*", 3.5e-3, 0, 2000},
    CostTolerance{"driver", "vulkan:lavapipe*", "raycast*", 5e-4, 1e-2, 2000},
    CostTolerance{"driver", "vulkan:lavapipe*", "tiles", 5e-4, 1e-2, 2000},
    CostTolerance{"driver", "*", "*", 5e-4, 0, 2000},
};

// Returns the tolerance in instructions. `stored` is the stored count of the part, and `frame` is
// the stored count of the whole frame.
[[nodiscard]] inline double cost_tolerance(std::string_view part, std::string_view device,
                                           std::string_view technique, double stored,
                                           double frame) {
  for (const CostTolerance& each : cost_tolerances) {
    if (each.part == part && core::glob_matches(each.device, device) &&
        core::glob_matches(each.technique, technique)) {
      return each.frame_share * frame + each.part_share * stored + each.count;
    }
  }
  return 0;
}

// The techniques whose number of cache misses is nearly the same in all runs. It varies slightly,
// because a buffer starts at a different offset within a cache line in each run. For volumes, it
// varied by at most 0.07 %, or by a few misses if there were only about a hundred. Sprites and
// tiles use about as much memory as the cache holds, so their number of misses varied by 5 %.
inline constexpr std::array<std::string_view, 2> techniques_with_stable_misses{"raycast*",
                                                                               "speed_of_light"};

// Returns the tolerance for the cache misses of device code, or nullopt if their number is not
// reproducible for this technique.
[[nodiscard]] inline std::optional<double> misses_tolerance(std::string_view technique,
                                                            double stored) {
  for (const std::string_view each : techniques_with_stable_misses) {
    if (core::glob_matches(each, technique)) return 16 + 0.01 * stored;
  }
  return std::nullopt;
}

}  // namespace triptych::judge
