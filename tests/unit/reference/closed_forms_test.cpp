// Compares the closed-form solutions with adaptive Gauss–Kronrod quadrature of their defining
// integrals, which shares no code with them.

#include "reference/closed_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/random.hpp"

namespace triptych::reference {
namespace {

double quadrature(const std::function<double(double)>& f, double a, double b) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, a, b, 12, 1e-14);
}

// Evaluates the defining integral numerically. `tau(t)` is the extinction at t, and `depth(t)` is
// the optical depth from the start of the ray to t.
Radiance by_quadrature(const std::function<double(double)>& tau,
                       const std::function<double(double)>& colour,
                       const std::function<double(double)>& depth, double length) {
  const double opacity = 1.0 - std::exp(-depth(length));
  return {quadrature([&](double t) { return colour(t) * tau(t) * std::exp(-depth(t)); }, 0, length),
          opacity};
}

TEST(ClosedForms, ConstantMediumMatchesItsDefinition) {
  const Radiance exact = v1_constant(0.7, 0.3, 2.5);
  const Radiance numeric = by_quadrature([](double) { return 0.7; }, [](double) { return 0.3; },
                                         [](double t) { return 0.7 * t; }, 2.5);
  EXPECT_NEAR(exact.colour, numeric.colour, 1e-14);
  EXPECT_NEAR(exact.opacity, numeric.opacity, 1e-14);
}

TEST(ClosedForms, ThinConstantMediumIsAccurate) {
  EXPECT_DOUBLE_EQ(v1_constant(1e-20, 1.0, 1.0).opacity, 1e-20);
}

TEST(ClosedForms, RampMatchesItsFormulaAndQuadrature) {
  for (const double k : {0.01, 0.5, 1.0, 2.0, 7.0, 40.0}) {
    const Radiance exact = v2_ramp(k);
    EXPECT_NEAR(exact.colour,
                -std::exp(-k / 2) +
                    std::sqrt(std::numbers::pi / (2 * k)) * boost::math::erf(std::sqrt(k / 2)),
                2e-15)
        << k;
    const Radiance numeric =
        by_quadrature([k](double t) { return k * t; }, [](double t) { return t; },
                      [k](double t) { return k * t * t / 2; }, 1.0);
    EXPECT_NEAR(exact.colour, numeric.colour, 1e-13) << k;
    EXPECT_NEAR(exact.opacity, numeric.opacity, 1e-14) << k;
  }
}

TEST(ClosedForms, RandomSegmentsMatchQuadrature) {
  core::Random random(1);
  for (int n = 0; n < 2000; ++n) {
    // The segments are thin to thick, and their extinction increases, decreases or is almost
    // constant.
    const double thickness = std::exp2(random.uniform(-12, 6));
    const double length = std::exp2(random.uniform(-4, 4));
    const double start = thickness / length * random.uniform();
    const double end = n % 3 == 0 ? start * (1 + std::exp2(random.uniform(-60, -1)))
                                  : thickness / length * random.uniform();
    const LinearSegment s{start, (end - start) / length, random.uniform(),
                          random.uniform(-1, 1) / length, length};
    const auto depth = [&](double t) { return t * (s.tau0 + s.tau1 * t / 2); };
    const Radiance exact = v3_segment(s);
    const Radiance numeric =
        by_quadrature([&](double t) { return s.tau0 + s.tau1 * t; },
                      [&](double t) { return s.colour0 + s.colour1 * t; }, depth, length);
    EXPECT_NEAR(exact.colour, numeric.colour, 1e-12) << n;
    EXPECT_NEAR(exact.opacity, numeric.opacity, 1e-13) << n;
    const double integral = quadrature([&](double t) { return std::exp(-depth(t)); }, 0, length);
    EXPECT_NEAR(transmittance_integral(s.tau0, s.tau1, length) / integral, 1.0, 1e-12) << n;
  }
}

TEST(ClosedForms, SegmentIsContinuousAsItsSlopeVanishes) {
  for (const double depth : {0.5, 3.0, 30.0}) {
    const double flat = transmittance_integral(depth, 0.0, 1.0);
    EXPECT_NEAR(flat, -std::expm1(-depth) / depth, 1e-15);
    for (const double slope : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-18, 1e-30, 1e-300}) {
      // With the depth a and the slope b, the integral is E = ∫ e^(−at − bt²/2) dt over [0, 1], so
      // dE/db = −∫t²/2·e^(−at − bt²/2) dt, which is in [−1/6, 0] at b = 0.
      EXPECT_NEAR(transmittance_integral(depth, slope, 1.0), flat, slope / 6 + 2e-15) << slope;
      EXPECT_NEAR(transmittance_integral(depth, -slope, 1.0), flat, slope / 6 + 2e-15) << slope;
    }
  }
}

TEST(ClosedForms, SplittingASegmentChangesNothing) {
  const LinearSegment whole{2.0, -1.5, 0.9, -0.4, 1.3};
  const LinearSegment front{2.0, -1.5, 0.9, -0.4, 0.5};
  const LinearSegment back{2.0 - 1.5 * 0.5, -1.5, 0.9 - 0.4 * 0.5, -0.4, 0.8};
  const Radiance joined = over(v3_segment(front), v3_segment(back));
  EXPECT_NEAR(joined.colour, v3_segment(whole).colour, 1e-15);
  EXPECT_NEAR(joined.opacity, v3_segment(whole).opacity, 1e-15);
}

TEST(ClosedForms, GaussianDepthMatchesQuadrature) {
  const double tau0 = 0.4;
  const double sigma = 1.7;
  for (const double p : {0.0, 0.9, 3.0, 8.0}) {
    const double numeric = quadrature(
        [&](double s) { return tau0 * std::exp(-(p * p + s * s) / (2 * sigma * sigma)); }, -3, 5);
    EXPECT_NEAR(v4_gaussian_depth(tau0, sigma, p, -3, 5), numeric, 1e-14);
  }
  EXPECT_NEAR(v4_gaussian_depth(tau0, sigma, 0, -1e3, 1e3),
              tau0 * sigma * std::sqrt(2 * std::numbers::pi), 1e-15);
}

TEST(ClosedForms, AtmosphereDepthMatchesQuadratureInBothDirections) {
  const double cosine = 0.6;
  const double numeric =
      quadrature([](double z) { return 2.0 * std::exp(-z / 0.8); }, 0.3, 2.0) / cosine;
  EXPECT_NEAR(v5_atmosphere_depth(2.0, 0.8, 0.3, 2.0, cosine), numeric, 1e-13);
  EXPECT_NEAR(v5_atmosphere_depth(2.0, 0.8, 2.0, 0.3, -cosine), numeric, 1e-13);
}

TEST(ClosedForms, LayersDependOnTheirOrder) {
  const Radiance front = v6_layers(1.0, 1.0, 0.7, 3.0, 0.0, 0.4);
  const Radiance behind = v6_layers(3.0, 0.0, 0.4, 1.0, 1.0, 0.7);
  EXPECT_NEAR(front.colour, 1 - std::exp(-0.7), 1e-15);
  EXPECT_NEAR(behind.colour, std::exp(-1.2) * (1 - std::exp(-0.7)), 1e-15);
  EXPECT_NEAR(front.opacity, 1 - std::exp(-1.9), 1e-15);
  EXPECT_NEAR(behind.opacity, front.opacity, 1e-15);
}

TEST(ClosedForms, DifferenceFactorIsThatOfASine) {
  for (const double k : {0.1, 1.0, 3.0}) {
    for (const double delta : {0.01, 0.5, 1.0}) {
      const double x = 0.7;
      const double difference =
          (std::sin(k * (x + delta)) - std::sin(k * (x - delta))) / (2 * delta);
      EXPECT_NEAR(v9_difference_factor(k, delta), difference / (k * std::cos(k * x)), 1e-13);
    }
  }
}

TEST(ClosedForms, LitWaveMatchesQuadrature) {
  for (const int power : {1, 2, 16}) {
    for (const double tau : {0.05, 1.0, 9.0}) {
      for (const double rate : {-1.3, 0.0, 0.2}) {
        const double phase = 1.4;
        const double numeric = quadrature(
            [&](double t) {
              return std::pow(std::sin(phase + rate * t), power) * tau * std::exp(-tau * t);
            },
            0, 2.0);
        EXPECT_NEAR(v9_lit_wave(tau, power, phase, rate, 2.0), numeric, 1e-13)
            << power << ' ' << tau << ' ' << rate;
      }
    }
  }
}

TEST(ClosedForms, ScaledErfcMatchesQuadrature) {
  // erfcx(x) = 2/√π·∫₀^∞ e^(−s² − 2xs) ds
  for (const double x : {0.0, 0.3, 1.0, 1.999, 2.0, 3.0, 5.0, 12.0, 1e3, 1e8}) {
    const double end = std::min(7.0, 20.0 / (x + 1e-300));
    const double numeric =
        2 * std::numbers::inv_sqrtpi *
        quadrature([x](double s) { return std::exp(-s * s - 2 * x * s); }, 0, end);
    EXPECT_NEAR(erfcx(x) / numeric, 1.0, 5e-15) << x;
  }
}

TEST(ClosedForms, DawsonMatchesQuadratureAndIsOdd) {
  for (const double x : {1e-9, 0.01, 0.4, 0.999, 1.0, 1.001, 2.0, 4.5, 9.0, 20.0}) {
    const double numeric = quadrature([x](double t) { return std::exp(t * t - x * x); }, 0, x);
    EXPECT_NEAR(dawson(x) / numeric, 1.0, 1e-14) << x;
    EXPECT_EQ(dawson(-x), -dawson(x));
  }
  EXPECT_NEAR(dawson(1e6) * 2e6, 1.0, 1e-11);
}

}  // namespace
}  // namespace triptych::reference
