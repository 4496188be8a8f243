#pragma once
// Two accepted devices: their stored residual r0 = ln B0 − ln A0 is exact, so that one by more than
// the repeatability of both is a change. r − r0 is the change of B less that of A.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "judge/correlation/factor_levels.hpp"

namespace triptych::judge {

// Instructions of one frame, of the two kinds of memory whose counts repeat.
struct FrameCost {
  double device_code = 0;
  double driver = 0;
  [[nodiscard]] double sum() const { return device_code + driver; }
};

// How far two counts of the same frame may be apart, as a share of it (docs/correlation.md). These
// bounds are systematic – how the heap happened to lie – and do not shrink with the square root of
// a number.
struct Repeatability {
  double device_code = 0;
  double driver = 5e-4;
};
[[nodiscard]] Repeatability repeatability(std::string_view device, std::string_view technique,
                                          const FrameCost& stored);
[[nodiscard]] Repeatability operator+(const Repeatability& a, const Repeatability& b);

// Of one configuration on one device since it was accepted, as shares of the stored sum.
struct CostChange {
  double device_code = 0;
  double driver = 0;
};
[[nodiscard]] CostChange change_of(const FrameCost& stored, const FrameCost& now);
// ln of the ratio that the parts beyond their bounds make; 0 where none is. Each part by itself, so
// that a change of generated code shows however loosely the driver repeats.
[[nodiscard]] double moved_by(const CostChange& change, const Repeatability& bound);
// Whether r left r0 by more than both devices repeat.
[[nodiscard]] bool residual_moved(const CostChange& a, const Repeatability& bound_a,
                                  const CostChange& b, const Repeatability& bound_b);

// What moved on one device, in as few words as tell it.
struct Movement {
  enum class Of : std::uint8_t { everything, level, configuration };
  Of of = Of::configuration;
  std::string level;                 // name, of a level
  std::vector<std::size_t> members;  // configurations
  double log_ratio = 0;              // median of the members; of a level its mean against the rest
  double least = 0;                  // of the members, by size
  double most = 0;
};

// `moved`: moved_by of each configuration. Everything first, then levels that explain most, then
// configurations that moved most. A configuration is named beside its level, or beside everything,
// only where it moved by more than twice as much, or the other way. A mean needs no bound of its
// own: bounds are systematic, so that a level is known no better than its configurations.
[[nodiscard]] std::vector<Movement> explain(std::span<const double> moved,
                                            std::span<const Factors> factors);

}  // namespace triptych::judge
