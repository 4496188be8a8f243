#include "scene/volume.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/error.hpp"
#include "scene/half.hpp"

namespace triptych::scene {
namespace {

constexpr std::array all_formats{VoxelFormat::u8, VoxelFormat::u16, VoxelFormat::f32,
                                 VoxelFormat::f16};

template <typename T>
constexpr ScalarType type_of() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return ScalarType::u8;
  if constexpr (std::is_same_v<T, std::int8_t>) return ScalarType::i8;
  if constexpr (std::is_same_v<T, std::uint16_t>) return ScalarType::u16;
  if constexpr (std::is_same_v<T, std::int16_t>) return ScalarType::i16;
  if constexpr (std::is_same_v<T, float>) return ScalarType::f32;
  return ScalarType::f64;
}

template <typename T>
Volume row_of(const std::vector<T>& values, double lo, double hi) {
  Volume volume;
  volume.name = "row";
  volume.size = {static_cast<int>(values.size()), 1, 1};
  volume.spacing = {1, 2, 3};
  volume.type = type_of<T>();
  volume.range_lo = lo;
  volume.range_hi = hi;
  volume.voxels.resize(values.size() * sizeof(T));
  std::memcpy(volume.voxels.data(), values.data(), volume.voxels.size());
  return volume;
}

template <typename T>
std::vector<T> every_value() {
  std::vector<T> values;
  for (int v = std::numeric_limits<T>::min(); v <= std::numeric_limits<T>::max(); ++v) {
    values.push_back(static_cast<T>(v));
  }
  return values;
}

// Checks that `stored·scale + offset` reproduces each value within the rounding of that formula.
template <typename T>
void expect_exact(VoxelFormat format, double lo, double hi) {
  const std::vector<T> values = every_value<T>();
  const VoxelGrid grid = encode(row_of(values, lo, hi), format);
  ASSERT_EQ(grid.voxel_count(), values.size());
  ASSERT_EQ(grid.data.size(), values.size() * bytes_of(format));
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_NEAR(grid.normalised(i), (values[i] - lo) / (hi - lo), 1e-12) << values[i];
  }
}

TEST(Encode, IntegersAreExactWhereTheyFit) {
  expect_exact<std::uint8_t>(VoxelFormat::u8, 0, 255);
  expect_exact<std::uint8_t>(VoxelFormat::u8, 17, 99);
  expect_exact<std::int8_t>(VoxelFormat::u8, -128, 127);
  expect_exact<std::uint8_t>(VoxelFormat::u16, 0, 255);
  expect_exact<std::int8_t>(VoxelFormat::u16, -100, 100);
  expect_exact<std::uint16_t>(VoxelFormat::u16, 0, 65535);
  expect_exact<std::int16_t>(VoxelFormat::u16, -32768, 32767);
  expect_exact<std::int16_t>(VoxelFormat::u16, 0, 2000);
}

TEST(Encode, KeepsTheBytesOfUnsignedIntegers) {
  Volume volume = row_of<std::uint16_t>({1, 500, 65535}, 1, 65535);
  const auto before = volume.voxels;
  const std::byte* storage = volume.voxels.data();
  const VoxelGrid grid = encode(std::move(volume), VoxelFormat::u16);
  EXPECT_EQ(grid.data, before);
  EXPECT_EQ(grid.data.data(), storage) << "the voxels were copied";
}

TEST(Encode, FloatsAreRoundedOnceFromDouble) {
  const std::vector<double> values{-3, -2.9, 0.1, 1.0 / 3, 4.999, 5};
  const VoxelGrid grid = encode(row_of(values, -3, 5), VoxelFormat::f32);
  EXPECT_EQ(grid.scale, 1);
  EXPECT_EQ(grid.offset, 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(grid.normalised(i), static_cast<double>(static_cast<float>((values[i] + 3) / 8)));
  }
}

TEST(Encode, LossyFormatsRoundToTheNearestStepOfTheRange) {
  const std::vector<float> values{0, 0.1F, 0.499F, 0.5F, 1};
  for (const auto& [format, steps] :
       {std::pair{VoxelFormat::u8, 255.0}, {VoxelFormat::u16, 65535.0}}) {
    const VoxelGrid grid = encode(row_of(values, 0, 1), format);
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_LE(std::abs(grid.normalised(i) - static_cast<double>(values[i])), 0.5 / steps + 1e-15);
    }
    EXPECT_EQ(grid.normalised(0), 0);
    EXPECT_EQ(grid.normalised(4), 1);
  }
  const VoxelGrid narrow =
      encode(row_of<std::uint16_t>({0, 30000, 65535}, 0, 65535), VoxelFormat::u8);
  EXPECT_NEAR(narrow.normalised(1), 30000.0 / 65535, 0.5 / 255 + 1e-15);
}

double half_at(const VoxelGrid& grid, std::size_t index) {
  Half half;
  std::memcpy(&half, grid.data.data() + index * sizeof half, sizeof half);
  return static_cast<double>(half);
}

// Tests three cases: signed 12-bit values of a scanner, bytes in a window larger than their range,
// and even numbers up to the largest half float.
TEST(Encode, HalvesStoreElevenBitIntegersExactly) {
  expect_exact<std::uint8_t>(VoxelFormat::f16, -3.5, 260);
  expect_exact<std::int8_t>(VoxelFormat::f16, -128, 127);
  EXPECT_TRUE(fits_halves(row_of<std::int16_t>({-1024, -1023, 0, 1023}, -1024, 1024)));
  EXPECT_FALSE(fits_halves(row_of<std::int16_t>({-1024, 1026, 1025}, -1024, 1026)));
  const std::vector<std::uint16_t> wide{0, 1, 2047, 2048, 4094, 65504};
  ASSERT_TRUE(fits_halves(row_of(wide, 0, 65504)));
  const VoxelGrid grid = encode(row_of(wide, 0, 65504), VoxelFormat::f16);
  for (std::size_t i = 0; i < wide.size(); ++i) EXPECT_EQ(half_at(grid, i), wide[i]);
  EXPECT_EQ(grid.normalised(5), 1);
}

// Tests values that half floats cannot represent: floats, wider integers, and clamped integers.
TEST(Encode, HalvesRoundOtherValues) {
  const auto expect_rounded = [](const Volume& volume) {
    ASSERT_FALSE(fits_halves(volume));
    Volume copy = volume;
    Volume floats = volume;
    const VoxelGrid grid = encode(std::move(copy), VoxelFormat::f16);
    const VoxelGrid exact = encode(std::move(floats), VoxelFormat::f32);
    for (std::size_t i = 0; i < grid.voxel_count(); ++i) {
      const double x = exact.normalised(i);
      ASSERT_LE(std::abs(grid.normalised(i) - x), half_roundoff * x + 0x1p-29) << x;
      const double stored = half_at(grid, i);
      ASSERT_TRUE(stored == 0 || (stored >= least_normal_half && stored <= largest_half));
    }
  };
  std::vector<float> floats{0, 1, 1e-30F, 0x1p-29F, 0x1.8p-30F, 0x1.ffep-1F};
  for (int i = 1; i < 4000; ++i) floats.push_back(static_cast<float>(std::exp2(-i * 0.01)));
  expect_rounded(row_of(floats, 0, 1));
  expect_rounded(row_of(every_value<std::uint16_t>(), 0, 65535));
  Volume clipped = row_of(every_value<std::uint8_t>(), 10.5, 200);
  clipped.clipped = true;
  expect_rounded(clipped);
}

TEST(Encode, NonFiniteVoxelsAreMappedToTheEnds) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::vector<double> values{std::numeric_limits<double>::quiet_NaN(), inf, -inf, 2};
  for (const auto format : all_formats) {
    const VoxelGrid grid = encode(row_of(values, 0, 4), format);
    EXPECT_EQ(grid.normalised(0), 0);
    EXPECT_EQ(grid.normalised(1), 1);
    EXPECT_EQ(grid.normalised(2), 0);
    EXPECT_NEAR(grid.normalised(3), 0.5, 0.5 / 255);
  }
}

TEST(Encode, AnEmptyRangeMapsEverythingToZero) {
  for (const auto format : all_formats) {
    EXPECT_EQ(encode(row_of<std::uint8_t>({7, 7}, 7, 7), format).normalised(1), 0);
    EXPECT_EQ(encode(row_of<float>({7, 7}, 7, 7), format).normalised(1), 0);
  }
}

TEST(Encode, TheWidestRangeDoesNotOverflow) {
  constexpr double most = std::numeric_limits<double>::max();
  const VoxelGrid grid = encode(row_of<double>({-most, 0, most}, -most, most), VoxelFormat::f32);
  EXPECT_EQ(grid.normalised(0), 0);
  EXPECT_EQ(grid.normalised(1), 0.5);
  EXPECT_EQ(grid.normalised(2), 1);
}

TEST(Encode, ZeroHasOneSign) {
  const VoxelGrid grid = encode(row_of<float>({-0.0F, 0.0F, 1}, -0.0, 1), VoxelFormat::f32);
  EXPECT_FALSE(std::signbit(grid.normalised(0)));
  EXPECT_FALSE(std::signbit(grid.normalised(1)));
}

TEST(Encode, CarriesGeometryRangeAndName) {
  const VoxelGrid grid = encode(row_of<std::uint8_t>({3, 9}, 3, 9), VoxelFormat::u8);
  EXPECT_EQ(grid.spacing, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(grid.range_lo, 3);
  EXPECT_EQ(grid.range_hi, 9);
  EXPECT_EQ(grid.name, "row");
}

TEST(Encode, HashDistinguishesVoxelsMappingAndGeometry) {
  const auto hash = [](const std::vector<std::uint8_t>& values, double lo, double hi,
                       VoxelFormat format) { return encode(row_of(values, lo, hi), format).hash; };
  const std::string base = hash({1, 2, 3}, 1, 3, VoxelFormat::u8);
  EXPECT_EQ(base,
            // This hash must be the same on every machine, because baselines contain such hashes.
            "cf634823698adb06e1995b9bbb56f84e");
  EXPECT_EQ(base, hash({1, 2, 3}, 1, 3, VoxelFormat::u8));
  EXPECT_NE(base, hash({1, 2, 4}, 1, 3, VoxelFormat::u8));
  EXPECT_NE(base, hash({1, 2, 3}, 0, 3, VoxelFormat::u8));
  EXPECT_NE(base, hash({1, 2, 3}, 1, 3, VoxelFormat::u16));
  Volume stretched = row_of<std::uint8_t>({1, 2, 3}, 1, 3);
  stretched.spacing[2] = 4;
  EXPECT_NE(base, encode(std::move(stretched), VoxelFormat::u8).hash);
}

TEST(Encode, RejectsVoxelsThatDoNotFillTheGrid) {
  Volume volume = row_of<std::uint8_t>({1, 2, 3}, 1, 3);
  volume.size[1] = 2;
  EXPECT_THROW((void)encode(std::move(volume), VoxelFormat::u8), core::InputError);
}

TEST(VoxelFormat, LosslessIsTheSmallestThatHoldsTheType) {
  EXPECT_EQ(lossless_format(ScalarType::u8), VoxelFormat::u8);
  EXPECT_EQ(lossless_format(ScalarType::i8), VoxelFormat::u8);
  EXPECT_EQ(lossless_format(ScalarType::u16), VoxelFormat::u16);
  EXPECT_EQ(lossless_format(ScalarType::i16), VoxelFormat::u16);
  EXPECT_EQ(lossless_format(ScalarType::f32), VoxelFormat::f32);
  EXPECT_EQ(lossless_format(ScalarType::f64), VoxelFormat::f32);
}

TEST(VoxelFormat, NamesRoundTrip) {
  for (const auto format : all_formats) {
    EXPECT_EQ(voxel_format(name_of(format)), format);
  }
  EXPECT_THROW((void)voxel_format("f64"), core::InputError);
}

TEST(Volume, ReadsBackEveryType) {
  EXPECT_EQ(row_of<std::int8_t>({-5}, 0, 1).value(0), -5);
  EXPECT_EQ(row_of<std::uint16_t>({1, 65535}, 0, 1).value(1), 65535);
  EXPECT_EQ(row_of<std::int16_t>({-32768}, 0, 1).value(0), -32768);
  EXPECT_EQ(row_of<float>({0.25F}, 0, 1).value(0), 0.25);
  EXPECT_EQ(row_of<double>({0.1}, 0, 1).value(0), 0.1);
  EXPECT_EQ(bytes_of(ScalarType::f64), 8U);
  EXPECT_EQ(name_of(ScalarType::i16), "i16");
}

}  // namespace
}  // namespace triptych::scene
