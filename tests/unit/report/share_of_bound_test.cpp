#include "report/figures/share_of_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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
  core::Image slightly = constant(0.75F);
  set(slightly, 0, 0, 0.76F);
  set(slightly, 1, 0, 1.0F);
  slightly = share_of_bound(slightly, constant(0.5F), constant(0.25F)).image;
  const std::vector<core::Image> all_beyond{color(0.3F), slightly};
  for (int i = 0; i <= 40; ++i) {
    const core::Image& beyond = all_beyond.at(static_cast<std::size_t>(i) / 21);
    const core::Image within = color(0.25F * static_cast<float>(i % 21) / 20);
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

// Errors of 2, 8 and 32 times the bound have the same distance in the image. A pixel whose bound is
// 0 has an infinite share, which does not change the scale.
TEST(ShareOfBound, ErrorsBeyondTheBoundAreOnALogarithmicScale) {
  core::Image image = constant(0.5F);
  core::Image bound = constant(0.0078125F);
  set(image, 1, 0, 0.515625F);
  set(image, 2, 0, 0.5625F);
  set(image, 3, 0, 0.75F);
  set(image, 4, 0, 0.6F);
  set(bound, 4, 0, 0);
  const ShareOfBound shares = share_of_bound(image, constant(0.5F), bound);
  EXPECT_EQ(shares.largest_finite, 32);
  const auto green = [&](int x) { return shares.image.pixel(x, 0).at(1); };
  EXPECT_NEAR(green(2) - green(1), green(3) - green(2), 1e-6);
  EXPECT_NEAR(green(2) - green(1), 0.32, 1e-6);
  EXPECT_EQ(green(3), 1);
  EXPECT_EQ(green(4), 1);
}

}  // namespace
}  // namespace triptych::report
