#pragma once
// Compares two accepted devices A and B. Their stored residual r0 = ln B0 − ln A0 is exact. If the
// residual r of the run differs from it by more than the repeatability of both devices, something
// has changed: r − r0 is the change of B minus that of A.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "judge/correlation/factor_levels.hpp"

namespace triptych::judge {

// The instructions of one frame, for the two parts whose counts repeat.
struct FrameCost {
  double device_code = 0;
  double driver = 0;
  [[nodiscard]] double sum() const { return device_code + driver; }
};

// The largest difference of two counts of the same frame, as a share of the frame
// (docs/correlation.md). The bounds are systematic (they depend on the layout of the heap), so they
// do not shrink with the square root of the number of counts.
struct Repeatability {
  double device_code = 0;
  double driver = 5e-4;
};
[[nodiscard]] Repeatability repeatability(std::string_view device, std::string_view technique,
                                          const FrameCost& stored);
[[nodiscard]] Repeatability operator+(const Repeatability& a, const Repeatability& b);

// The change of one configuration on one device since it was accepted, as shares of the stored sum.
struct CostChange {
  double device_code = 0;
  double driver = 0;
};
[[nodiscard]] CostChange change_of(const FrameCost& stored, const FrameCost& now);
// ln of the ratio of the frame's cost that results from the parts that moved beyond their bounds; 0
// if none did. Each part is judged by itself, so that a change of generated code is visible even if
// the driver's count repeats only loosely.
[[nodiscard]] double moved_by(const CostChange& change, const Repeatability& bound);
// Whether r differs from r0 by more than the repeatability of both devices.
[[nodiscard]] bool residual_moved(const CostChange& a, const Repeatability& bound_a,
                                  const CostChange& b, const Repeatability& bound_b);

// The change on one device, described with as few names as possible.
struct Movement {
  enum class Of : std::uint8_t { everything, level, configuration };
  Of of = Of::configuration;
  std::string level;                 // the name, if a level moved
  std::vector<std::size_t> members;  // configurations
  double log_ratio = 0;  // median of the members; for a level, its mean against the rest
  double least = 0;      // the smallest absolute value among the members
  double most = 0;
};

// `moved`: the result of moved_by for each configuration. The result first names everything, if all
// configurations moved together, then the levels that explain most, then the configurations that
// moved most. A configuration is named in addition to its level, or to everything, only if it moved
// by more than twice as much or in the other direction. The mean of a level has the same bound as
// its configurations, because bounds are systematic and do not average out.
[[nodiscard]] std::vector<Movement> explain(std::span<const double> moved,
                                            std::span<const Factors> factors);

}  // namespace triptych::judge
