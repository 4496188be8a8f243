// Tests the error images that the window shows, and the bound on the difference between two correct
// devices.

#include "view/shown_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/error.hpp"

namespace triptych::view {
namespace {

using testing::HasSubstr;

core::Image flat(float value) {
  core::Image image(4, 2);
  for (float& each : image.rgba) each = value;
  return image;
}

TEST(ShownError, StatesTheShareOfTheBound) {
  core::Image image = flat(0.5F);
  image.rgba[4] += 0.03F;
  const ShownError error = shown_error(image, flat(0.5F), flat(0.1F), "");
  EXPECT_TRUE(error.right);
  EXPECT_NEAR(error.share, 0.3, 1e-6);
  EXPECT_EQ(error.beyond, 0U);
  EXPECT_TRUE(error.rings.empty());
  EXPECT_EQ(error.headline, "errors up to 0.3 times the bound");
  EXPECT_EQ(error.displayed.rgb.size(), 3U * 4 * 2);
}

TEST(ShownError, RingsAPixelBeyondTheBound) {
  core::Image image = flat(0.5F);
  image.rgba[4 * 6 + 1] += 0.2F;
  for (const char* other : {"", "gl:x"}) {
    const ShownError error = shown_error(image, flat(0.5F), flat(0.1F), other);
    EXPECT_FALSE(error.right);
    EXPECT_EQ(error.beyond, 1U);
    ASSERT_EQ(error.rings.size(), 1U);
    EXPECT_EQ(error.rings.front().x, 2);
    EXPECT_EQ(error.rings.front().y, 1);
    EXPECT_THAT(error.headline, HasSubstr("1 pixel beyond"));
    EXPECT_THAT(error.sentence, HasSubstr("(2, 1)"));
  }
}

TEST(ShownError, ImagesOfDifferentSizesHaveNoDifference) {
  const ShownError error = shown_error(core::Image(3, 2), flat(0), flat(1), "");
  EXPECT_FALSE(error.right);
  EXPECT_TRUE(error.displayed.rgb.empty());
}

// Two devices at opposite ends of their bounds are both correct. A device beyond both bounds is
// not.
TEST(BoundBetween, IsTheSumOfBothBoundsAndTheDistanceOfTheReferences) {
  const accuracy::TruthPair a{flat(0.5F), flat(0.125F)};
  const accuracy::TruthPair b{flat(0.75F), flat(0.0625F)};
  const core::Image bound = bound_between(a, b);
  for (const float each : bound.rgba) {
    EXPECT_GE(each, 0.4375F);
    EXPECT_LE(each, 0.4376F);
  }
  EXPECT_TRUE(shown_error(flat(0.375F), flat(0.8125F), bound, "gl:x").right);
  EXPECT_FALSE(shown_error(flat(0.375F), flat(0.8130F), bound, "gl:x").right);
  EXPECT_THROW((void)bound_between(a, {core::Image(1, 1), core::Image(1, 1)}), core::InputError);
}

TEST(BoundBetween, RequiresTheSameSurfaceWhereBothReferencesAreCertain) {
  constexpr float nothing = std::numeric_limits<float>::infinity();
  accuracy::TruthPair a{flat(0), flat(0.1F)};
  a.truth.ids = {1, 1, 1, core::Image::no_particle, 1, 1, 1, 1};
  a.truth.depth = {2, 2, 2, nothing, 2, 2, 2, 2};
  a.bound.ids = {0, 1, 0, 0, 0, 0, 0, 0};
  a.bound.depth = std::vector<float>(8, 0.25F);
  accuracy::TruthPair b = a;
  b.bound.ids = {0, 0, 1, 0, 0, 0, 0, 0};
  b.truth.ids[4] = 7;
  const core::Image bound = bound_between(a, b);
  EXPECT_THAT(bound.ids, testing::ElementsAre(0, 1, 1, 0, 1, 0, 0, 0));
  EXPECT_NEAR(bound.depth[3], 0.5, 1e-6);
}

TEST(ScaleOfBounds, ExtendsBeyondTheBound) {
  const core::RgbImage scale = scale_of_bounds(111);
  const auto pixel = [&](std::size_t x) {
    return std::array{scale.rgb[3 * x], scale.rgb[3 * x + 1], scale.rgb[3 * x + 2]};
  };
  EXPECT_EQ(pixel(0), (std::array<std::uint8_t, 3>{0, 0, 0}));
  EXPECT_EQ(pixel(100), (std::array<std::uint8_t, 3>{255, 255, 255}));
  EXPECT_EQ(pixel(110), (std::array<std::uint8_t, 3>{0, 255, 255}));
}

}  // namespace
}  // namespace triptych::view
