#include "scene/value_window.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "core/random.hpp"
#include "scene/empty_image.hpp"

namespace triptych::scene {
namespace {

template <typename T>
Volume row_of(const std::vector<T>& values, ScalarType type) {
  Volume volume{.name = "row", .size = {static_cast<int>(values.size()), 1, 1}, .type = type};
  const auto [lo, hi] = std::ranges::minmax(values);
  volume.range_lo = static_cast<double>(lo);
  volume.range_hi = static_cast<double>(hi);
  volume.voxels.resize(values.size() * sizeof(T));
  std::memcpy(volume.voxels.data(), values.data(), volume.voxels.size());
  return volume;
}

Volume mapped(Volume volume, std::string_view window, Mapping mapping = Mapping::linear) {
  set_window(volume, parse_window(window), mapping);
  return volume;
}

VoxelGrid natural(Volume volume) {
  const VoxelFormat format = lossless_format(volume);
  return encode(std::move(volume), format);
}

// Returns values with a long tail: most are small, and the largest are about a thousand times the
// median.
std::vector<float> long_tail(int count) {
  core::Random random(7);
  std::vector<float> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(static_cast<float>(std::exp(14 * random.uniform() - 7)));
  }
  return values;
}

TEST(Window, IsReadFromEitherKindOfEnd) {
  EXPECT_FALSE(parse_window("full"));
  const auto absolute = parse_window("-0.5..3e2");
  ASSERT_TRUE(absolute);
  EXPECT_EQ(absolute->lo.number, -0.5);
  EXPECT_EQ(absolute->hi.number, 300);
  EXPECT_FALSE(absolute->lo.percentile || absolute->hi.percentile);
  const auto mixed = parse_window("0..p99.5");
  ASSERT_TRUE(mixed);
  EXPECT_FALSE(mixed->lo.percentile);
  EXPECT_TRUE(mixed->hi.percentile);
  EXPECT_EQ(mixed->hi.number, 99.5);
}

TEST(Window, RejectsInvalidWindows) {
  for (const char* text : {"", "own", "1", "1..", "..1", "1..x", "p1..q2", "p-1..p5", "p1..p101",
                           "nan..1", "0..inf", "p..p5", "1..2..3", "2..1", "1..1", "p9..p9"}) {
    EXPECT_THROW((void)parse_window(text), core::InputError) << text;
  }
}

TEST(Window, FullAndLinearLeavesAVolumeUnchanged) {
  const Volume volume = row_of<std::int16_t>({-7, 0, 900}, ScalarType::i16);
  const VoxelGrid grid = natural(mapped(volume, "full"));
  EXPECT_EQ(grid.format, VoxelFormat::u16);
  EXPECT_EQ(grid.hash, natural(volume).hash);
}

TEST(Window, IsLinearBetweenItsEndsAndFlatBeyond) {
  const std::vector<float> values = long_tail(500);
  const VoxelGrid grid = natural(mapped(row_of(values, ScalarType::f32), "0.25..4"));
  EXPECT_EQ(grid.range_lo, 0.25);
  EXPECT_EQ(grid.range_hi, 4);
  int between = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = (static_cast<double>(values[i]) - 0.25) / 3.75;
    between += x > 0 && x < 1;
    ASSERT_NEAR(grid.normalised(i), std::clamp(x, 0.0, 1.0), 0x1.0p-25) << values[i];
  }
  EXPECT_GT(between, 50);
}

// Checks the definition of a percentile directly, without sorting.
TEST(Window, PercentilesAreTheSmallestValuesThatEnoughVoxelsDoNotExceed) {
  for (const int count : {1, 2, 99, 100, 101, 777}) {
    std::vector<float> values = long_tail(count);
    // Creates a tie.
    values.push_back(values.front());
    for (const double percent : {0.0, 0.5, 1.0, 37.0, 50.0, 99.0, 99.9}) {
      const double found =
          mapped(row_of(values, ScalarType::f32), "p" + std::to_string(percent) + "..1e9").range_lo;
      const auto share = [&](auto&& has) {
        return 100.0 * static_cast<double>(std::ranges::count_if(values, has)) /
               static_cast<double>(values.size());
      };
      EXPECT_TRUE(std::ranges::find(values, static_cast<float>(found)) != values.end());
      EXPECT_GE(share([&](float v) { return static_cast<double>(v) <= found; }), percent - 1e-9);
      if (percent > 0) {
        EXPECT_LT(share([&](float v) { return static_cast<double>(v) < found; }), percent);
      }
    }
  }
}

TEST(Window, PercentilesCountFiniteValuesAndOfALogarithmPositiveOnes) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::vector<double> values{inf, 1, -5, 4, std::nan(""), 2, 0, 3, -inf};
  Volume volume = row_of(values, ScalarType::f64);
  volume.range_lo = -5;
  volume.range_hi = 4;
  const Volume linear = mapped(volume, "p0..p100");
  EXPECT_EQ(linear.range_lo, -5);
  EXPECT_EQ(linear.range_hi, 4);
  const Volume logarithmic = mapped(volume, "p25..p75", Mapping::logarithmic);
  EXPECT_EQ(logarithmic.range_lo, 1);
  EXPECT_EQ(logarithmic.range_hi, 3);
  EXPECT_EQ(mapped(volume, "full", Mapping::logarithmic).range_lo, 1);
}

TEST(Mapping, OfALogarithmMatchesItsFormula) {
  const std::vector<float> values = long_tail(500);
  const Volume volume = row_of(values, ScalarType::f32);
  for (const char* window : {"full", "0.01..20", "p5..p95"}) {
    const Volume of = mapped(volume, window, Mapping::logarithmic);
    const VoxelGrid grid = natural(of);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double x = std::log10(static_cast<double>(values[i]) / of.range_lo) /
                       std::log10(of.range_hi / of.range_lo);
      ASSERT_NEAR(grid.normalised(i), std::clamp(x, 0.0, 1.0), 0x1.0p-25) << values[i];
    }
  }
}

TEST(Mapping, OfALogarithmIsDefinedForEveryValue) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  constexpr double most = std::numeric_limits<double>::max();
  const std::vector<double> values{std::nan(""), -inf, -1, -0.0, 0, least, 1, most, inf};
  Volume volume = row_of(values, ScalarType::f64);
  volume.range_lo = -1;
  volume.range_hi = most;
  for (const VoxelFormat format : {VoxelFormat::u8, VoxelFormat::u16, VoxelFormat::f32}) {
    const VoxelGrid grid = encode(mapped(volume, "full", Mapping::logarithmic), format);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(grid.normalised(i), 0) << i;
    const double one = std::log(least) / (std::log(least) - std::log(most));
    EXPECT_NEAR(grid.normalised(6), one, 0.5 / 255);
    EXPECT_EQ(grid.normalised(7), 1);
    EXPECT_EQ(grid.normalised(8), 1);
  }
}

// The results must be bit-identical on every machine, because baselines contain hashes of such
// data.
TEST(Mapping, OfALogarithmIsBitIdenticalEverywhere) {
  std::vector<std::uint16_t> values(65536);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint16_t>(i);
  const Volume volume = mapped(row_of(values, ScalarType::u16), "3..50000", Mapping::logarithmic);
  EXPECT_EQ(natural(volume).hash, "1176a8c2bc5c422b6ff6ee7730b5203c");
}

TEST(LosslessFormat, IsThatOfTheIntegersUnlessAMappingChangesThem) {
  const Volume volume = row_of<std::uint8_t>({10, 20, 200}, ScalarType::u8);
  const Volume wider = mapped(volume, "0..250");
  EXPECT_EQ(lossless_format(wider), VoxelFormat::u8);
  const VoxelGrid unchanged = natural(wider);
  EXPECT_EQ(unchanged.data, volume.voxels);
  EXPECT_NEAR(unchanged.normalised(1), 20.0 / 250, 1e-12);
  EXPECT_EQ(lossless_format(mapped(volume, "10..199.5")), VoxelFormat::f32);
  EXPECT_EQ(lossless_format(mapped(volume, "full", Mapping::logarithmic)), VoxelFormat::f32);
}

// If a window is narrower than the range of values, all steps of the format lie within the window,
// so the rounding is finer.
TEST(LosslessFormat, IntegersThatAreClampedAreRoundedToStepsOfTheWindow) {
  std::vector<std::uint16_t> values;
  for (int v = 0; v < 2000; ++v) values.push_back(static_cast<std::uint16_t>(v));
  const Volume volume = row_of(values, ScalarType::u16);
  const VoxelGrid grid = encode(mapped(volume, "100..400"), VoxelFormat::u8);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = std::clamp((values[i] - 100) / 300.0, 0.0, 1.0);
    ASSERT_NEAR(grid.normalised(i), x, 0.5 / 255 + 1e-12) << values[i];
  }
  const std::vector<std::uint8_t> bytes{0, 99, 150, 201, 255};
  const VoxelGrid narrow =
      encode(mapped(row_of(bytes, ScalarType::u8), "100..200"), VoxelFormat::u8);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double x = std::clamp((bytes[i] - 100) / 100.0, 0.0, 1.0);
    EXPECT_NEAR(narrow.normalised(i), x, 0.5 / 255 + 1e-12);
  }
}

void expect_window_refused(const Volume& volume, std::string_view window, Mapping mapping,
                           const std::string& words) {
  EXPECT_THAT([&] { (void)mapped(volume, window, mapping); },
              testing::ThrowsMessage<core::InputError>(testing::HasSubstr(words)));
}

TEST(Window, ReportsWindowsThatDoNotFitTheVoxels) {
  const Volume zeros = row_of<std::uint8_t>({0, 0, 0, 9}, ScalarType::u8);
  expect_window_refused(zeros, "p1..p50", Mapping::linear,
                        "row: the window 0..0 is empty (the range of the values is 0..9)");
  expect_window_refused(zeros, "12..p100", Mapping::linear,
                        "row: the window 12..9 is empty (the range of the values is 0..9)");
  expect_window_refused(
      zeros, "-1..5", Mapping::logarithmic,
      "row: mapping=log requires a window with a positive lower end, but it begins at -1 (the "
      "range of the positive values is 9..9)");
  const Volume negative = row_of<float>({-3, -2}, ScalarType::f32);
  expect_window_refused(negative, "full", Mapping::logarithmic,
                        "row: mapping=log requires positive values");
  const Volume none = row_of<float>({std::nanf("")}, ScalarType::f32);
  expect_window_refused(none, "p1..p99", Mapping::linear, "row: no voxel has a finite value");
}

// 20000 small values, and one large value.
Volume mostly_small() {
  std::vector<float> values;
  for (int i = 0; i < 20000; ++i) values.push_back(static_cast<float>(i % 100));
  values.push_back(1300);
  return row_of(values, ScalarType::f32);
}

TEST(Window, ThatMissesNearlyAllValuesIsNoted) {
  using testing::AllOf;
  using testing::ElementsAre;
  using testing::HasSubstr;
  using testing::IsEmpty;
  EXPECT_THAT(mapped(mostly_small(), "5000..10000").facts.notes,
              ElementsAre(AllOf(HasSubstr("100 % of the values are below the window 5000..10000"),
                                HasSubstr("0..1300"), HasSubstr("p50 50"))));
  EXPECT_THAT(mapped(mostly_small(), "100..1300").facts.notes,
              ElementsAre(HasSubstr("99.995 % of the values are below")));
  EXPECT_THAT(mapped(mostly_small(), "-9..-1").facts.notes,
              ElementsAre(HasSubstr("100 % of the values are above")));
  EXPECT_THAT(mapped(mostly_small(), "98..1300").facts.notes, IsEmpty());
  // No value is inside the window, but values on both sides are visible.
  EXPECT_THAT(mapped(mostly_small(), "50.2..50.8").facts.notes, IsEmpty());
  EXPECT_THAT(mapped(mostly_small(), "full").facts.notes, IsEmpty());
}

TEST(Window, KnowsWhichPartOfItTheValuesUse) {
  using testing::ElementsAre;
  EXPECT_THAT(mapped(mostly_small(), "full").used, ElementsAre(0, 1));
  EXPECT_THAT(mapped(mostly_small(), "5000..10000").used, ElementsAre(0, 0));
  EXPECT_THAT(mapped(mostly_small(), "-1300..3900").used, ElementsAre(0.25, 0.5));
  EXPECT_THAT(mapped(mostly_small(), "1..3000", Mapping::logarithmic).used[0], 0);
}

TEST(EmptyImage, IsNotedIfTheTransferFunctionIsTransparentForAllValues) {
  using testing::HasSubstr;
  TransferFunction function = load_transfer_function("haze");  // transparent below 1/8
  const auto note = [&](const ValueMapping& values) { return empty_image_note(function, values); };
  EXPECT_EQ(note({.lo = 0, .hi = 1300}), "");
  EXPECT_THAT(note({.lo = 5000, .hi = 10000, .used = {0, 0}}),
              HasSubstr("visible only for values between 5615.23 and 10000"));
  EXPECT_THAT(note({.lo = 1, .hi = 65536, .mapping = Mapping::logarithmic, .used = {0, 0.1}}),
              HasSubstr("between 3.91"));
  EXPECT_EQ(note({.lo = 0, .hi = 100, .used = {0, 0.2}}), "");
  EXPECT_THAT(note({.lo = 7, .hi = 7}), HasSubstr("all values are equal (7)"));
  for (auto& entry : function.entries) entry[3] = 0;
  EXPECT_THAT(note({.lo = 0, .hi = 1}), HasSubstr("all of its entries have the opacity 0"));
}

}  // namespace
}  // namespace triptych::scene
