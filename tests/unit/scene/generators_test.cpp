#include "scene/generators.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace triptych::scene {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::array<int, 3> size{24, 17, 20};

std::size_t index_of(const Volume& volume, int i, int j, int k) {
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(volume.size[0]) *
             (static_cast<std::size_t>(j) +
              static_cast<std::size_t>(volume.size[1]) * static_cast<std::size_t>(k));
}

// Compares a generated volume with the formula `field(u, v, w)`, which is computed with the C
// library.
template <typename Field>
void expect_field(const Volume& volume, double tolerance, Field&& field) {
  for (int k = 0; k < volume.size[2]; ++k) {
    for (int j = 0; j < volume.size[1]; ++j) {
      for (int i = 0; i < volume.size[0]; ++i) {
        const double expected = field((i + 0.5) / volume.size[0], (j + 0.5) / volume.size[1],
                                      (k + 0.5) / volume.size[2]);
        const double x = volume.value(index_of(volume, i, j, k)) / volume.range_hi;
        ASSERT_NEAR(x, expected, tolerance) << i << ' ' << j << ' ' << k;
      }
    }
  }
}

constexpr double float_rounding = 0x1p-24;

// Generated volumes must be bit-identical on every machine. If a hash changes, the data set has
// changed, and every baseline that depends on it has to be accepted again.
TEST(Generators, MakeTheSameBitsEverywhere) {
  const std::map<std::string_view, std::string> golden{
      {"uniform_box", "d0e96d0c4eb979ba168352d2fa7c40d7"},
      {"gradient_box", "7023871505549c7c9200190090f9156f"},
      {"frequency_box", "c03256e653069006282ec884f3534b9c"},
      {"mandelbulb", "bce22b07842eb61489f3205aba9fdaae"},
      {"marschner_lobb", "e9317f355c60b4d10b6730fa9a1ffa71"},
      {"nested_shells", "1f23235fc07879e6c236b1698551da91"},
      {"sparse_field", "c054e0d3500817b6be49536534a3f41b"},
      {"gaussian_blob", "03734ea47283219a4718fba3d215c2a4"},
  };
  const auto infos = volume_generators();
  ASSERT_EQ(infos.size(), golden.size());
  for (const GeneratorInfo& info : infos) {
    EXPECT_EQ(core::content_hash(generate_volume(info.name, size).voxels), golden.at(info.name))
        << info.name;
  }
}

TEST(Generators, KeepTheStatedRangeAndUseEveryType) {
  std::map<ScalarType, int> types;
  for (const GeneratorInfo& info : volume_generators()) {
    const Volume volume = generate_volume(info.name, size);
    EXPECT_EQ(volume.size, size);
    EXPECT_EQ(volume.spacing, (std::array<double, 3>{1, 1, 1}));
    ASSERT_EQ(volume.voxels.size(), volume.voxel_count() * bytes_of(volume.type)) << info.name;
    for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
      ASSERT_GE(volume.value(i), volume.range_lo) << info.name;
      ASSERT_LE(volume.value(i), volume.range_hi) << info.name;
    }
    EXPECT_FALSE(info.summary.empty());
    ++types[volume.type];
  }
  EXPECT_GE(types[ScalarType::u8], 2);
  EXPECT_GE(types[ScalarType::u16], 2);
  EXPECT_GE(types[ScalarType::f32], 2);
}

TEST(Generators, UniformAndGradient) {
  expect_field(generate_volume("uniform_box", size), 0, [](double, double, double) { return 0.5; });
  const Volume ramp = generate_volume("gradient_box", size);
  EXPECT_EQ(ramp.range_hi, 24 + 17 + 20 - 3);
  EXPECT_EQ(ramp.value(0), 0);
  EXPECT_EQ(ramp.value(ramp.voxel_count() - 1), ramp.range_hi);
  EXPECT_EQ(ramp.value(index_of(ramp, 3, 5, 7)), 15);
}

TEST(Generators, FrequencyBoxHasTwelvePeriods) {
  const auto wave = [](double t) { return std::sin(2 * std::numbers::pi * 12 * t); };
  expect_field(
      generate_volume("frequency_box", {64, 40, 33}), float_rounding,
      [&](double u, double v, double w) { return 0.5 + 0.5 * wave(u) * wave(v) * wave(w); });
}

TEST(Generators, MarschnerLobbIsThePublishedSignal) {
  using std::numbers::pi;
  expect_field(generate_volume("marschner_lobb", size), float_rounding,
               [](double u, double v, double w) {
                 const double x = 2 * u - 1;
                 const double y = 2 * v - 1;
                 const double z = 2 * w - 1;
                 const double rho = std::cos(2 * pi * 6 * std::cos(pi * std::hypot(x, y) / 2));
                 return (1 - std::sin(pi * z / 2) + 0.25 * (1 + rho)) / (2 * 1.25);
               });
}

TEST(Generators, GaussianBlobHasTheStatedWidth) {
  const Volume volume = generate_volume("gaussian_blob", size);
  const double sigma = 17 / 8.0;
  for (int i = 0; i < size[0]; ++i) {
    const double x = i + 0.5 - 12;
    const double z = 10 + 0.5 - 10;
    EXPECT_NEAR(volume.value(index_of(volume, i, 8, 10)),
                std::exp(-(x * x + z * z) / (2 * sigma * sigma)), float_rounding);
  }
}

TEST(Generators, NestedShellsPeakAtTheirRadii) {
  const Volume volume = generate_volume("nested_shells", {201, 1, 1});
  const auto along_x = [&](double radius) {
    return volume.value(index_of(volume, static_cast<int>(100.5 * (1 + radius)), 0, 0)) / 65535;
  };
  EXPECT_NEAR(along_x(0.3), 1.0, 0.01);
  EXPECT_NEAR(along_x(0.6), 0.7, 0.01);
  EXPECT_NEAR(along_x(0.9), 0.4, 0.01);
  for (const double between : {0.0, 0.2, 0.45, 0.75}) EXPECT_EQ(along_x(between), 0) << between;
}

TEST(Generators, SparseFieldIsMostlyExactlyZero) {
  const Volume volume = generate_volume("sparse_field", {64, 64, 64});
  std::size_t occupied = 0;
  double largest = 0;
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
    if (volume.value(i) != 0) ++occupied;
    largest = std::max(largest, volume.value(i));
  }
  const double share = static_cast<double>(occupied) / static_cast<double>(volume.voxel_count());
  EXPECT_GT(share, 0.03);
  EXPECT_LT(share, 0.06);
  EXPECT_GT(largest, 250);
}

// The set contains the origin, lies within a radius of 1.2, and has an eightfold symmetry about the
// z axis in the plane z = 0. Only the fourfold symmetry is checked.
TEST(Generators, MandelbulbHasItsKnownProperties) {
  const Volume volume = generate_volume("mandelbulb", {48, 48, 48});
  EXPECT_EQ(volume.value(index_of(volume, 24, 24, 24)), 255);
  EXPECT_EQ(volume.value(0), 0);
  for (int i = 0; i < 48; ++i) {
    for (int j = 0; j < 48; ++j) {
      const double value = volume.value(index_of(volume, i, j, 20));
      EXPECT_NEAR(volume.value(index_of(volume, i, 47 - j, 20)), value, 1);
    }
  }
}

TEST(Generators, SmallestSizes) {
  for (const GeneratorInfo& info : volume_generators()) {
    EXPECT_EQ(generate_volume(info.name, {1, 1, 1}).voxel_count(), 1U);
    EXPECT_EQ(generate_volume(info.name, {1, 7, 1}).voxel_count(), 7U);
  }
}

TEST(Generators, NameThemselves) {
  EXPECT_EQ(generate_volume("uniform_box", {8, 8, 8}).name, "generate:uniform_box:8");
  EXPECT_EQ(generate_volume("uniform_box", {8, 4, 8}).name, "generate:uniform_box:8x4x8");
}

TEST(Generators, RejectUnknownNamesAndSizes) {
  EXPECT_THAT([] { (void)generate_volume("mandelbul", size); },
              ThrowsMessage<core::InputError>(
                  testing::AllOf(HasSubstr("'mandelbul'"), HasSubstr("gaussian_blob"))));
  for (const int n : {0, -1, 4097}) {
    EXPECT_THROW((void)generate_volume("uniform_box", {1, n, 1}), core::InputError) << n;
  }
}

}  // namespace
}  // namespace triptych::scene
