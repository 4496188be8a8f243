// Compares logarithm, exponential and opacity in single and double precision with long double.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "technique/portable/prelude.hpp"

namespace triptych::technique {
namespace {

using Wide = long double;

// Error bounds as stated in volume_math.h, in units of the round-off (2⁻²⁴ for float, 2⁻⁵³ for
// double).
struct Single {
  using Real = float;
  static constexpr Wide roundoff = 0x1p-24L;
  static constexpr Wide logarithm = 5.2L;
  static constexpr Wide exponential = 2.3L;
  static constexpr Wide opacity = 8;
  static Real log2_1m(Real alpha) { return portable::tri_log2_1m(alpha); }
  static Real one_minus_exp2(Real z) { return portable::tri_1m_exp2(z); }
  static Real opacity_of(Real alpha, Real steps) { return portable::tri_opacity(alpha, steps); }
};
struct Double {
  using Real = double;
  static constexpr Wide roundoff = 0x1p-53L;
  static constexpr Wide logarithm = 6;
  static constexpr Wide exponential = 5;
  static constexpr Wide opacity = 12;
  static Real log2_1m(Real alpha) { return portable::fp64::tri_log2_1m(alpha); }
  static Real one_minus_exp2(Real z) { return portable::fp64::tri_1m_exp2(z); }
  static Real opacity_of(Real alpha, Real steps) {
    return portable::fp64::tri_opacity(alpha, steps);
  }
};

template <class Precision>
class VolumeMath : public testing::Test {
 protected:
  using Number = typename Precision::Real;

  // Returns opacities from the smallest that differs from 0 to the largest below 1. They are dense
  // at both ends, and where 1 − opacity is near √½, because the computed logarithm uses another
  // exponent on either side of √½.
  static std::vector<Number> opacities() {
    core::Random random(5);
    const Number step = static_cast<Number>(2 * Precision::roundoff);
    std::vector<Number> all{step, 1 - step / 2, static_cast<Number>(1 - std::sqrt(0.5L)),
                            Number{0.5}};
    for (int n = 0; n < 20000; ++n) {
      const double exponent = random.uniform(-60, -1);
      all.push_back(static_cast<Number>(std::exp2(exponent)));
      all.push_back(static_cast<Number>(random.uniform(0, 1)));
      all.push_back(std::min(static_cast<Number>(1 - std::exp2(exponent / 2)), 1 - step / 2));
      all.push_back(static_cast<Number>(0.29289 + random.uniform(-1e-4, 1e-4)));
    }
    return all;
  }

  static Wide relative_error(Number value, Wide exact) {
    return std::abs(static_cast<Wide>(value) - exact) / std::abs(exact) / Precision::roundoff;
  }
};

using Precisions = testing::Types<Single, Double>;
TYPED_TEST_SUITE(VolumeMath, Precisions);

TYPED_TEST(VolumeMath, LogarithmErrsByNoMoreThanStated) {
  Wide worst = 0;
  for (const auto alpha : this->opacities()) {
    if (!(alpha > 0)) continue;
    const Wide exact = std::log1p(-static_cast<Wide>(alpha)) / std::log(2.0L);
    worst = std::max(worst, this->relative_error(TypeParam::log2_1m(alpha), exact));
  }
  EXPECT_LE(worst, TypeParam::logarithm);
}

TYPED_TEST(VolumeMath, ExponentialErrsByNoMoreThanStated) {
  using Real = typename TypeParam::Real;
  core::Random random(6);
  Wide worst = 0;
  for (int n = 0; n < 40000; ++n) {
    const auto z = static_cast<Real>(-std::exp2(random.uniform(-60, 11)));
    const Wide exact = -std::expm1(static_cast<Wide>(z) * std::log(2.0L));
    worst = std::max(worst, this->relative_error(TypeParam::one_minus_exp2(z), exact));
  }
  EXPECT_LE(worst, TypeParam::exponential);
}

TYPED_TEST(VolumeMath, OpacityErrsByNoMoreThanStated) {
  using Real = typename TypeParam::Real;
  core::Random random(7);
  Wide worst = 0;
  for (const Real alpha : this->opacities()) {
    if (!(alpha > 0)) continue;
    const auto steps = static_cast<Real>(std::exp2(random.uniform(-20, 6)));
    const Wide exact =
        -std::expm1(static_cast<Wide>(steps) * std::log1p(-static_cast<Wide>(alpha)));
    worst = std::max(worst, this->relative_error(TypeParam::opacity_of(alpha, steps), exact));
  }
  EXPECT_LE(worst, TypeParam::opacity);
}

TYPED_TEST(VolumeMath, OpacityIsExactAtBothEnds) {
  using Real = typename TypeParam::Real;
  for (const Real steps : {Real{0x1p-20}, Real{0.25}, Real{1}, Real{500}}) {
    EXPECT_EQ(TypeParam::opacity_of(0, steps), 0);
    EXPECT_EQ(TypeParam::opacity_of(1, steps), 1);
  }
  EXPECT_EQ(TypeParam::one_minus_exp2(static_cast<Real>(-5000)), 1);
}

}  // namespace
}  // namespace triptych::technique
