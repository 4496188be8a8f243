#pragma once
// Finds changes in the costs of two accepted devices, A and B. The residual r of a configuration is
// the logarithm of its cost on B minus the logarithm of its cost on A; r0 is the same difference
// for the stored costs. If r differs from r0 by more than the counts of the two devices may vary
// between measurements, the cost on A or on B has changed.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "judge/correlation/factor_levels.hpp"

namespace triptych::judge {

// The instructions of one frame, for the two parts whose counts are reproducible.
struct FrameCost {
  double device_code = 0;
  double driver = 0;
  [[nodiscard]] double sum() const { return device_code + driver; }
};

// The largest difference between two counts of the same frame, as a share of the frame's cost
// (docs/correlation.md). The differences are systematic, because they depend on the layout of the
// heap. Therefore averaging over many counts does not reduce them.
struct Repeatability {
  double device_code = 0;
  double driver = 5e-4;
};
[[nodiscard]] Repeatability repeatability(std::string_view device, std::string_view technique,
                                          const FrameCost& stored);
[[nodiscard]] Repeatability operator+(const Repeatability& a, const Repeatability& b);

// The change in the cost of one configuration on one device since it was accepted, as shares of the
// stored cost of the frame.
struct CostChange {
  double device_code = 0;
  double driver = 0;
};
[[nodiscard]] CostChange change_of(const FrameCost& stored, const FrameCost& now);
// Returns ln(new cost/old cost) of the frame, counting only the parts (device code, driver) whose
// change exceeds their value in `bound`. Returns 0 if there is no such part. Each part is judged
// separately, so that a change in device code is detected even if the driver's count varies a lot.
[[nodiscard]] double significant_change(const CostChange& change, const Repeatability& bound);
// Returns whether the ratio of the costs of two devices, A and B, differs from the stored ratio by
// more than the repeatability of both.
[[nodiscard]] bool residual_moved(const CostChange& a, const Repeatability& bound_a,
                                  const CostChange& b, const Repeatability& bound_b);

// A change in cost on one device. It applies to all configurations, to the configurations with a
// factor level, or to a single configuration.
struct Movement {
  enum class Scope : std::uint8_t { everything, level, configuration };
  Scope scope = Scope::configuration;
  std::string level;                 // the name of the level, if `scope` is Scope::level
  std::vector<std::size_t> members;  // indices of the configurations
  // The median change of the members. For a level: their mean change minus the mean change of all
  // other configurations.
  double log_ratio = 0;
  double least = 0;  // the change of the member that changed least
  double most = 0;   // the change of the member that changed most
};

// Describes the changes of all configurations with as few movements as possible. `moved` contains
// the result of significant_change() for each configuration. The result begins with a movement of
// everything if all configurations changed in the same direction. Then follow the levels that
// explain most of the changes and, finally, single configurations, the largest change first. A
// configuration that another movement already covers is returned only if it changed by more than
// twice as much as that movement, or in the opposite direction.
[[nodiscard]] std::vector<Movement> explain(std::span<const double> moved,
                                            std::span<const Factors> factors);

}  // namespace triptych::judge
