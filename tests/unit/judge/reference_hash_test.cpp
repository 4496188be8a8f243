#include "judge/baselines/reference_hash.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace triptych::judge {
namespace {

core::Image make_image(std::uint64_t seed) {
  core::Random random(seed);
  core::Image image(64, 64);
  for (float& value : image.rgba) value = static_cast<float>(random.uniform());
  return image;
}

// This test changes some values by one ulp of a float. That is about 10⁵ times as much as a
// different math library changes a value in double precision.
TEST(ReferenceHash, LastBitsDoNotChangeTheHash) {
  int same = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const core::Image image = make_image(seed);
    core::Image other = image;
    core::Random random(1000 + seed);
    // After rounding to floats, a different math library changes about one value in a few thousand.
    // Here, about one value in a thousand changes.
    for (float& value : other.rgba) {
      if (random.uniform() < 1e-3) value = std::nextafter(value, 2.0F);
    }
    same += is_same_reference(reference_hash(image), reference_hash(other)) ? 1 : 0;
  }
  EXPECT_EQ(same, 100);
}

TEST(ReferenceHash, OneVisiblyDifferentPixelChangesTheHash) {
  const core::Image image = make_image(1);
  for (const std::size_t at : {0UL, 77UL, image.rgba.size() - 1}) {
    core::Image other = image;
    other.rgba[at] += 1.0F / 4000;
    EXPECT_FALSE(is_same_reference(reference_hash(image), reference_hash(other))) << at;
  }
}

TEST(ReferenceHash, ASmallChangeOfAllPixelsChangesTheHash) {
  const core::Image image = make_image(1);
  core::Image other = image;
  for (float& value : other.rgba) value += 1e-6F;
  EXPECT_FALSE(is_same_reference(reference_hash(image), reference_hash(other)));
}

TEST(ReferenceHash, SizesChangeTheHashAndNonFiniteNumbersAreHandled) {
  core::Image image(2, 3);
  EXPECT_FALSE(is_same_reference(reference_hash(image), reference_hash(core::Image(3, 2))));
  const ReferenceHash plain = reference_hash(image);
  image.rgba[0] = std::numeric_limits<float>::quiet_NaN();
  image.rgba[1] = std::numeric_limits<float>::infinity();
  image.rgba[2] = -1e30F;
  EXPECT_FALSE(is_same_reference(plain, reference_hash(image)));
  EXPECT_TRUE(is_same_reference(reference_hash(image), reference_hash(image)));
}

// The hash depends on the cell of a grid into which each value falls. The grids are placed so that
// round numbers, which are frequent in the colours of scenes, are not near the edge of a cell.
TEST(ReferenceHash, RoundNumbersMayMoveByALastBit) {
  for (const float value : {0.0F, 0.25F, 0.5F, 1.0F, 1.0F / 4096, 1.0F / 8192}) {
    core::Image image(1, 1);
    image.rgba.assign(4, value);
    core::Image other = image;
    other.rgba.assign(4, std::nextafter(value, -1.0F));
    EXPECT_EQ(reference_hash(image), reference_hash(other)) << value;
  }
}

}  // namespace
}  // namespace triptych::judge
