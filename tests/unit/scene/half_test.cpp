#include "scene/half.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace triptych::scene {
namespace {

double value_of(unsigned bits) {
  return static_cast<double>(Half{static_cast<std::uint16_t>(bits)});
}

TEST(Half, EveryOneIsReadBack) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    const double value = value_of(bits);
    if (std::isnan(value)) continue;
    ASSERT_EQ(to_half(value).bits, bits) << value;
  }
  EXPECT_TRUE(std::isnan(value_of(to_half(std::numeric_limits<double>::quiet_NaN()).bits)));
}

TEST(Half, HasTheValuesOfTheStandard) {
  EXPECT_EQ(value_of(0x3c00), 1);
  EXPECT_EQ(value_of(0x3555), 0.333251953125);
  EXPECT_EQ(value_of(0x7bff), largest_half);
  EXPECT_EQ(value_of(0x0400), least_normal_half);
  EXPECT_EQ(value_of(0x0001), 0x1p-24);
  EXPECT_EQ(value_of(0xc000), -2);
}

// A number between two half floats is rounded to the nearer one. A number halfway between them is
// rounded to the one whose last bit is 0.
TEST(Half, RoundsToTheNearest) {
  for (unsigned bits = 0; bits < 0x7bff; ++bits) {
    const double below = value_of(bits);
    const double above = value_of(bits + 1);
    const double middle = (below + above) / 2;
    ASSERT_EQ(to_half(std::nextafter(middle, 0)).bits, bits);
    ASSERT_EQ(to_half(middle).bits, bits + bits % 2);
    ASSERT_EQ(to_half(std::nextafter(middle, above)).bits, bits + 1);
    if (below >= least_normal_half) {
      ASSERT_LE(middle - below, half_roundoff / (1 + half_roundoff) * middle);
    }
  }
  EXPECT_EQ(to_half(65519).bits, 0x7bff);
  EXPECT_EQ(to_half(65520).bits, 0x7c00);
  EXPECT_EQ(to_half(-1e300).bits, 0xfc00);
}

}  // namespace
}  // namespace triptych::scene
