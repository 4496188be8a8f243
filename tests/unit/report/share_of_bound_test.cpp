#include "report/figures/share_of_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace triptych::report {
namespace {

constexpr int side = 96;

core::Image constant(float value) {
  core::Image image(side, side);
  for (float& each : image.rgba) each = value;
  return image;
}

void set(core::Image& image, int x, int y, float value) {
  image.rgba[4 * (static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x))] = value;
}

TEST(ShareOfBound, MarksASinglePixel) {
  core::Image image = constant(0.5F);
  set(image, 70, 20, 0.6F);
  const ShareOfBound shares = share_of_bound(image, constant(0.5F), constant(0.05F));
  ASSERT_EQ(shares.marks.size(), 1U);
  EXPECT_EQ(shares.marks[0].x, 70);
  EXPECT_EQ(shares.marks[0].y, 20);
  EXPECT_EQ(shares.x, 70);
}

TEST(ShareOfBound, MarksTheWorstFirstWithoutOverlaps) {
  core::Image image = constant(0.5F);
  set(image, 10, 10, 0.6F);
  set(image, 11, 10, 0.7F);
  set(image, 80, 80, 0.9F);
  const ShareOfBound shares = share_of_bound(image, constant(0.5F), constant(0.05F));
  ASSERT_EQ(shares.marks.size(), 2U);
  EXPECT_EQ(shares.marks[0].x, 80);
  EXPECT_EQ(shares.marks[1].x, 11);
  const core::Image wrong = constant(0.9F);
  const ShareOfBound all = share_of_bound(wrong, constant(0.5F), constant(0.05F));
  EXPECT_EQ(all.marks.size(), 12U);
  for (std::size_t i = 0; i < all.marks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(std::hypot(all.marks[i].x - all.marks[j].x, all.marks[i].y - all.marks[j].y),
                2 * all.ring_radius);
    }
  }
}

// Pixels beyond the bound must differ from every colour of the ramp either in lightness or along
// the blue–yellow axis, which red–green colour-blind readers can distinguish.
TEST(ShareOfBound, PixelsBeyondTheBoundAreDistinguishable) {
  const auto color = [](float error) {
    return share_of_bound(constant(0.5F + error), constant(0.5F), constant(0.25F)).image;
  };
  const core::Image beyond = color(0.3F);
  for (int i = 0; i <= 20; ++i) {
    const core::Image within = color(0.25F * static_cast<float>(i) / 20);
    const auto lightness = [](const core::Image& image) {
      return 0.2126 * image.rgba[0] + 0.7152 * image.rgba[1] + 0.0722 * image.rgba[2];
    };
    const auto blue = [](const core::Image& image) {
      return image.rgba[2] - 0.5 * (image.rgba[0] + image.rgba[1]);
    };
    const double distance =
        std::hypot(lightness(within) - lightness(beyond), blue(within) - blue(beyond));
    EXPECT_GT(distance, 0.3) << i;
  }
}

}  // namespace
}  // namespace triptych::report
