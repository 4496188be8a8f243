// Compares the preintegration table and its maths with brute-force integration in long double.

#include "technique/volume/preintegration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/hash.hpp"
#include "core/random.hpp"
#include "scene/transfer_function.hpp"
#include "technique/portable/prelude.hpp"

namespace triptych::technique {
namespace {

using Wide = long double;

struct Light {
  Wide opacity = 0;
  std::array<Wide, 3> colour{};
};

// Integrates the light along a path of `length` voxels between two positions in the table, with the
// midpoint rule and a very large number of parts.
Light integrate(const scene::TransferFunction& function, Wide from, Wide to, Wide length,
                int parts) {
  Light light;
  Wide transmittance = 1;
  for (int n = 0; n < parts; ++n) {
    const Wide u = from + (to - from) * (static_cast<Wide>(n) + 0.5L) / parts;
    const auto k = std::min<std::size_t>(static_cast<std::size_t>(u), 254);
    const Wide f = u - static_cast<Wide>(k);
    const auto at = [&](std::size_t c) {
      const Wide a = function.entries[k][c];
      return a + f * (static_cast<Wide>(function.entries[k + 1][c]) - a);
    };
    const Wide opacity = -std::expm1(length / parts * std::log1p(-at(3)));
    for (std::size_t c = 0; c < 3; ++c) light.colour[c] += transmittance * opacity * at(c);
    transmittance *= 1 - opacity;
  }
  light.opacity = 1 - transmittance;
  return light;
}

// Computes the light along a path of `length` voxels from the table, as the kernels do.
Light by_table(const std::vector<std::array<float, 4>>& pairs, std::size_t from, std::size_t to,
               float length) {
  const auto* pair = &pairs[texels_per_pair * (256 * from + to)];
  const auto cells = static_cast<float>(from < to ? to - from : from - to);
  const float depth = length / cells * pair[0][0];
  const float opacity = portable::tri_1m_exp2(-depth);
  const float z = 0.3465735903F * depth;
  const float w = portable::tri_attenuation(z, opacity);
  Light light{.opacity = opacity};
  for (std::size_t c = 0; c < 3; ++c) {
    light.colour[c] =
        opacity * (pair[0][c + 1] - z / (3 + w) * pair[1][c] + w / (3 + w) * pair[2][c]);
  }
  return light;
}

double largest_difference(const Light& a, const Light& b) {
  Wide largest = std::abs(a.opacity - b.opacity);
  for (std::size_t c = 0; c < 3; ++c) {
    largest = std::max(largest, std::abs(a.colour[c] - b.colour[c]));
  }
  return static_cast<double>(largest);
}

// The truncation error is at most (range of colour)·D⁴/635 for optical depth D, and far smaller for
// the smooth function here. The rest of the tolerance allows for the round-off of a dozen
// operations.
TEST(PreintegratedPairs, MatchTheIntegralsBetweenEntries) {
  scene::TransferFunction function;
  for (std::size_t k = 0; k < 256; ++k) {
    const float g = static_cast<float>(k) / 255;
    function.entries[k] = {g, 1 - g, 0.25F + 0.5F * g, 0.3F - 0.25F * g};
  }
  const auto pairs = preintegrated_pairs(function);
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 32},
                                 {32, 0},
                                 {100, 101},
                                 {255, 200},
                                 {17, 90},
                                 {0, 255}}) {
    for (const float length : {0.0625F, 0.5F, 1.0F, 2.0F}) {
      const Light exact = integrate(function, static_cast<Wide>(from), static_cast<Wide>(to),
                                    static_cast<Wide>(length), 20000);
      const double depth = -std::log1p(-static_cast<double>(exact.opacity));
      EXPECT_LT(largest_difference(by_table(pairs, from, to, length), exact),
                1.2e-6 * depth + std::pow(depth, 5) * 1e-4)
          << from << ' ' << to << ' ' << length;
    }
  }
}

TEST(PreintegratedPairs, SteepFunctionsStayWithinTheCutOff) {
  core::Random random(11);
  scene::TransferFunction function;
  for (auto& entry : function.entries) {
    for (std::size_t c = 0; c < 3; ++c) entry[c] = static_cast<float>(random.uniform(0, 1));
    const double u = random.uniform(0, 1);
    entry[3] = u < 0.3 ? 0.0F : static_cast<float>(random.uniform(0, 0.99));
  }
  const auto pairs = preintegrated_pairs(function);
  for (int n = 0; n < 40; ++n) {
    const auto from = static_cast<std::size_t>(random.uniform(0, 256));
    const auto to = (from + 1 + static_cast<std::size_t>(random.uniform(0, 40))) % 256;
    const auto length = static_cast<float>(std::exp2(random.uniform(-6, 0)));
    const Light exact = integrate(function, static_cast<Wide>(from), static_cast<Wide>(to),
                                  static_cast<Wide>(length), 40000);
    const double depth = -std::log1p(-static_cast<double>(exact.opacity));
    const Light found = by_table(pairs, from, to, length);
    EXPECT_NEAR(static_cast<double>(found.opacity), static_cast<double>(exact.opacity), 2e-6);
    EXPECT_LE(largest_difference(found, exact), std::pow(depth, 4) / 635 + 2e-6) << depth;
  }
}

// Devices read this table, so it must be bit-identical on every machine.
TEST(PreintegratedPairs, AreTheSameEverywhere) {
  const auto pairs = preintegrated_pairs(scene::load_transfer_function("surfaces"));
  EXPECT_EQ(core::HashBuilder("pairs").add_array(std::span(pairs)).hash(),
            "81bbfa4674ecfbe4d87b7bc27375ea93");
}

TEST(PreintegratedPairs, TransparentPathsHaveNoDepth) {
  const auto pairs = preintegrated_pairs(scene::load_transfer_function("surfaces"));
  EXPECT_EQ(pairs[texels_per_pair * (256 * 3 + 40)][0], 0);
  EXPECT_EQ(pairs[texels_per_pair * (256 * 40 + 3)][0], 0);
  EXPECT_GT(pairs[texels_per_pair * (256 * 3 + 110)][0], 0);
}

TEST(PreintegratedPairs, FullOpacityLeavesNothing) {
  scene::TransferFunction function;
  for (std::size_t k = 0; k < 256; ++k) function.entries[k] = {1, 0.5F, 0, k < 100 ? 0.0F : 1.0F};
  const auto pairs = preintegrated_pairs(function);
  const Light light = by_table(pairs, 120, 121, 1.0F / 64);
  EXPECT_EQ(light.opacity, 1);
  EXPECT_NEAR(static_cast<double>(light.colour[0]), 1, 1e-6);
}

TEST(PreintegrationMath, MeanOfTheLogarithmHasTheStatedError) {
  core::Random random(5);
  for (int n = 0; n < 20000; ++n) {
    const auto a = static_cast<float>(random.uniform(0, 1));
    const auto b = static_cast<float>(
        n % 2 == 0 ? random.uniform(0, 1)
                   : std::clamp(static_cast<double>(a) + random.uniform(-1e-3, 1e-3), 0.0, 1.0));
    if (a == b) continue;
    const auto integral = [](Wide alpha) {
      return alpha < 1 ? (1 - alpha) * std::log1p(-alpha) + alpha : Wide{1};
    };
    const Wide exact = (integral(b) - integral(a)) / (static_cast<Wide>(b) - static_cast<Wide>(a));
    const double r = std::abs(0.5 * (static_cast<double>(b) - static_cast<double>(a))) /
                     (1 - 0.5 * (static_cast<double>(a) + static_cast<double>(b)));
    const double rest = std::min(std::pow(r, 14) / (210 * (1 - r * r)), 0.038);
    // The opacity in the middle of a cell is rounded only once.
    const double middle = 0x1.0p-24 / (1 - 0.5 * (static_cast<double>(a) + static_cast<double>(b)));
    const double found = -0.6931471805599453 * portable::tri_mean_log2_1m(a, b);
    ASSERT_NEAR(found, static_cast<double>(exact),
                rest + middle + 11 * 0x1.0p-24 * static_cast<double>(exact) + 1e-12)
        << a << ' ' << b;
  }
}

TEST(PreintegrationMath, AttenuationMatchesTheLangevinFunction) {
  for (int n = 1; n <= 4000; ++n) {
    const auto z = static_cast<float>(std::exp2(-14 + n * 0.005));
    const float opacity = portable::tri_1m_exp2(-2.885390082F * z);
    const Wide wide = z;
    const Wide q = wide * wide;
    // Evaluates the continued fraction with far more terms than necessary.
    Wide w = q / 61;
    for (int level = 59; level >= 5; level -= 2) w = q / (level + w);
    const Wide langevin = wide / (3 + w);
    const float found = portable::tri_attenuation(z, opacity);
    ASSERT_NEAR(z / (3 + found), static_cast<double>(langevin), 1e-6) << z;
    ASSERT_NEAR(found / (3 + found), static_cast<double>(w / (3 + w)), 2e-6) << z;
  }
}

}  // namespace
}  // namespace triptych::technique
