// Tests the quadrature `preintegrated` in double precision: compares the step with closed-form
// solutions and brute-force integration, and the image with the limit image.

#include "reference/preintegrated.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/analytic_scenes.hpp"
#include "reference/closed_forms.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {
namespace {

constexpr ErrorModel exact{};

double value_at(double position) {
  return (position + 0.5) / 256;
}

Segment segment(const Table& table, double from, double to, double length) {
  return Preintegration(table, exact)({value_at(from), 0}, {value_at(to), 0},
                                      {length, length, length});
}

// A step passes through a range of table entries, called its path. If a path starts between two
// opaque entries, only the colour at its start is visible. If it starts in a cell (between two
// entries) with only one opaque entry, the colours of both entries are visible.
TEST(PreintegratedStep, EndsWhereItsPathIsOpaque) {
  scene::TransferFunction function;
  for (std::size_t k = 0; k < 256; ++k) {
    function.entries[k] = {k % 2 == 0 ? 1.0F : 0.0F, static_cast<float>(k) / 255, 0.5F,
                           k < 120 || k > 140 ? 0.0F : 1.0F};
  }
  const Table table(function, 0);
  for (const auto& [from, to] : {std::pair{121.25, 133.5}, {133.5, 121.25}, {125.25, 125.75}}) {
    const Segment found = segment(table, from, to, 0.07);
    EXPECT_EQ(found.opacity.nominal, 1);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.lookup.colour[i], table.at(from)[i], 1e-12) << from << ' ' << to;
    }
  }
  // The integral is ∫ c·τT from entry 119 on, with colour c, extinction τ and transmittance T. The
  // cell before the opaque entry absorbs most of the light, so little of it is left for the entry
  // itself.
  const Segment ramp = segment(table, 119, 130, 11);
  double seen = 0;
  double left = 1;
  constexpr int parts = 1'000'000;
  for (int n = 0; n < parts; ++n) {
    const double alpha = (n + 0.5) / parts;
    const double opacity = step_opacity(alpha, 1.0 / parts);
    seen += left * opacity * alpha;  // red rises from 0 to 1 together with the opacity
    left -= left * opacity;
  }
  EXPECT_NEAR(ramp.lookup.colour[0], seen + left, 1e-6);
}

// Problem V3 (reference/closed_forms.hpp) has linear extinction and linear colour. Because the
// table stores opacity, extinction deviates from a line by 1e-7 between entries.
TEST(PreintegratedStep, IsV3WhereTheTableIsARamp) {
  scene::TransferFunction function;
  for (std::size_t k = 0; k < 256; ++k) {
    const double g = static_cast<double>(k) / 255;
    function.entries[k] = {static_cast<float>(g), static_cast<float>(1 - g), 0.5F,
                           static_cast<float>(-std::expm1(-(0.1 + 0.4 * g)))};
  }
  const Table table(function, 0);
  for (const auto& [from, to] : {std::pair{0.0, 255.0}, {255.0, 0.0}, {17.3, 49.8}, {90.2, 90.7}}) {
    for (const double length : {0.1, 1.0, 7.0}) {
      const auto tau = [](double u) { return 0.1 + 0.4 * u / 255; };
      const Radiance red = v3_segment({tau(from), (tau(to) - tau(from)) / length, from / 255,
                                       (to - from) / 255 / length, length});
      const Segment found = segment(table, from, to, length);
      EXPECT_NEAR(found.opacity.nominal, red.opacity, 1e-6 * length);
      EXPECT_NEAR(found.opacity.nominal * found.lookup.colour[0], red.colour, 1e-6 * length)
          << from << ' ' << to << ' ' << length;
      EXPECT_NEAR(found.lookup.colour[2], 0.5, 1e-12);
    }
  }
}

// For a table with jumps and spikes, one preintegrated step must agree with the sum of many short
// steps of constant opacity.
TEST(PreintegratedStep, IsTheIntegralOfASteepTable) {
  scene::TransferFunction function;
  for (std::size_t k = 0; k < 256; ++k) {
    const auto x = static_cast<float>(k);
    function.entries[k] = {x / 255, k % 2 == 0 ? 1.0F : 0.0F, 1 - x / 255,
                           k % 7 == 3 ? 0.9F : 0.0F};
  }
  const Table table(function, 0);
  for (const auto& [from, to] : {std::pair{2.5, 12.25}, {12.25, 2.5}, {9.2, 9.9}, {-0.4, 3.0}}) {
    const double length = 0.7;
    constexpr int parts = 200000;
    std::array<double, 3> colour{};
    double left = 1;
    for (int n = 0; n < parts; ++n) {
      const double u = std::max(from + (to - from) * (n + 0.5) / parts, 0.0);
      const Table::Rgba c = table.at(u);
      const double opacity = step_opacity(c[3], length / parts);
      for (std::size_t i = 0; i < 3; ++i) colour[i] += left * opacity * c[i];
      left -= left * opacity;
    }
    const Segment found = segment(table, from, to, length);
    EXPECT_NEAR(found.opacity.nominal, 1 - left, 1e-8);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.opacity.nominal * found.lookup.colour[i], colour[i], 1e-8) << from;
    }
  }
}

TEST(PreintegratedStep, FullOpacityHidesEverythingBehind) {
  scene::TransferFunction function;
  for (std::size_t k = 0; k < 256; ++k) function.entries[k] = {1, 0, 0, k < 20 ? 0.0F : 1.0F};
  const Table table(function, 0);
  EXPECT_EQ(segment(table, 30, 40, 0.01).opacity.nominal, 1);
  EXPECT_EQ(segment(table, 5, 15, 9).opacity.nominal, 0);
  EXPECT_GT(segment(table, 19, 21, 0.01).opacity.nominal, 0.9999);
}

double largest_error(const AnalyticScene& analytic, const Truth& truth) {
  double largest = 0;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const AnalyticPixel pixel = analytic.exact(x, y);
      for (std::size_t c = 0; c < 4; ++c) {
        const auto i = static_cast<std::size_t>(4 * (y * truth.width + x)) + c;
        largest = std::max(largest, std::abs(truth.rgba[i] - pixel.rgba[c]) - pixel.model_error);
      }
    }
  }
  return largest;
}

TEST(PreintegratedImage, IsExactOnTheRampBetweenPlateaus) {
  AnalyticOptions options;
  options.size = {8, 8, 8};
  for (const double step : {0.21, 0.5, 1.0}) {
    options.step_voxels = step;
    AnalyticScene analytic = analytic_scene(AnalyticProblem::v3_plateaus, options);
    EXPECT_GT(largest_error(analytic, render_volume(analytic.scene)), 1e-5);
    analytic.scene.quadrature = scene::Quadrature::preintegrated;
    EXPECT_LE(largest_error(analytic, render_volume(analytic.scene)), 0) << step;
  }
}

TEST(PreintegratedImage, ConvergesToTheLimitOfTheMidpointRule) {
  AnalyticOptions options;
  options.size = {10, 10, 10};
  AnalyticScene analytic = analytic_scene(AnalyticProblem::v4_gaussian, options);
  const Truth limit = render_volume_converged(analytic.scene, 1e-8);
  analytic.scene.quadrature = scene::Quadrature::preintegrated;
  std::vector<double> errors;
  for (const double step : {0.5, 0.125}) {
    analytic.scene.step_voxels = step;
    const Truth truth = render_volume(analytic.scene);
    double sum = 0;
    for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
      sum += std::pow(truth.rgba[i] - limit.rgba[i], 2);
    }
    errors.push_back(std::sqrt(sum / static_cast<double>(truth.rgba.size())));
  }
  EXPECT_GE(std::log2(errors[0] / errors[1]) / 2, 1.9);
}

}  // namespace
}  // namespace triptych::reference
