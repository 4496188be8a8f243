#include "reference/opacity.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::reference {

namespace {

// Most steps are powers of two, for which no logarithm is needed: 1 − √(1 − α) = α/(1 + √(1 − α))
// halves a step, and 1 − (1 − α)² = α·(2 − α) doubles it. Neither formula suffers from
// cancellation, and both are rounded in the same way on every machine.
constexpr int most_doublings = 5;

double doubled(double alpha, int times) {
  for (; times < 0; ++times) alpha /= 1.0 + std::sqrt(1.0 - alpha);
  for (; times > 0; --times) alpha *= 2.0 - alpha;
  return alpha;
}

}  // namespace

double step_opacity(double alpha, double steps) {
  if (!(steps > 0.0) || !(alpha > 0.0)) return 0.0;
  if (alpha >= 1.0) return 1.0;
  int exponent = 0;
  if (std::frexp(steps, &exponent) == 0.5 && std::abs(exponent - 1) <= most_doublings) {
    return doubled(alpha, exponent - 1);
  }
  return -std::expm1(steps * std::log1p(-alpha));
}

namespace {

// Returns a bound on the change of a sample's opacity that is caused by the error of the opacity
// per voxel length. The bound is fast to compute, because it needs no further powers, but it is
// valid only for small errors. It follows from the mean value theorem. Let α be the opacity per
// voxel length, δ its error, r = δ/(1−α), and s the length of the sample in voxels (`steps`). On
// [α−δ, α+δ], the derivative s·(1−α)^(s−1) is largest at α+δ for s < 1 and at α−δ for s ≥ 1. In
// both cases it is at most s·(1−α)^s/(1−α)·(1 + z + 2z²) with z = max(1, s)·r, if z ≤ 1/20. For
// larger z, the function returns a negative number.
double small_change(const TableLookup& lookup, double steps, double nominal) {
  const double left = 1.0 - lookup.alpha;
  const double change = std::max(lookup.alpha_hi - lookup.alpha, lookup.alpha - lookup.alpha_lo);
  if (change == 0.0) return 0.0;
  const double z = std::max(1.0, steps) * change;
  if (!(z <= 0.05 * left)) return -1.0;
  const double y = z / left;
  return steps * (1.0 - nominal) / left * change * (1.0 + y + 2.0 * y * y);
}

}  // namespace

StepOpacity step_opacity(const TableLookup& lookup, const StepLength& steps,
                         double relative_error) {
  StepOpacity opacity;
  opacity.nominal = step_opacity(lookup.alpha, steps.nominal);
  opacity.lo = opacity.hi = opacity.nominal;
  const bool whole = steps.shortest == steps.nominal && steps.longest == steps.nominal;
  const double change = whole ? small_change(lookup, steps.nominal, opacity.nominal) : -1.0;
  if (change >= 0.0) {
    opacity.lo -= change;
    opacity.hi += change;
  } else {
    opacity.lo = step_opacity(lookup.alpha_lo, steps.shortest);
    opacity.hi = step_opacity(lookup.alpha_hi, steps.longest);
  }
  opacity.lo = std::max(opacity.lo * (1.0 - relative_error), 0.0);
  opacity.hi = std::min(opacity.hi * (1.0 + relative_error), 1.0);
  return opacity;
}

}  // namespace triptych::reference
