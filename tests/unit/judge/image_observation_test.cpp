#include "judge/image_observation.hpp"

#include <gtest/gtest.h>

namespace triptych::judge {
namespace {

constexpr int width = 8;
constexpr int height = 6;

core::Image filled(float value) {
  core::Image image(width, height);
  for (float& each : image.rgba) each = value;
  return image;
}

float& red(core::Image& image, int x, int y) {
  return image.rgba[4 * static_cast<std::size_t>(y * width + x)];
}

Observation observed(const core::Image& image, const core::Image& truth, const core::Image& bound) {
  return image_observation(accuracy::compare(image, truth, bound), image, truth,
                           Against::reference);
}

// The pixel (1, 2) has the largest error. The pixel (6, 0) has a smaller error, but a bound of 0.
TEST(ImageObservation, NamesThePixelWithTheLargestErrorAndTheOneWithTheLargestRatio) {
  const core::Image truth = filled(0.25F);
  core::Image image = truth;
  core::Image bound = filled(0.0625F);
  red(image, 1, 2) = 0.75F;
  red(image, 6, 0) = 0.375F;
  red(bound, 6, 0) = 0;
  const Observation what = observed(image, truth, bound);
  EXPECT_EQ(what.number("max_error"), 0.5);
  EXPECT_EQ(what.number("max_error_bound"), 0.0625);
  EXPECT_EQ(what.number("max_error_x"), 1);
  EXPECT_EQ(what.number("max_error_y"), 2);
  EXPECT_EQ(what.number("error"), 0.125);
  EXPECT_EQ(what.number("bound"), 0);
  EXPECT_EQ(what.number("x"), 6);
  EXPECT_EQ(what.number("y"), 0);
}

// The rectangle is reported even if it is as large as the image.
TEST(ImageObservation, ContainsTheRectangleOfTheWrongPixels) {
  const core::Image truth = filled(0.25F);
  const Observation what = observed(filled(0.75F), truth, filled(0.0625F));
  EXPECT_TRUE(what.numbers.contains("wrong_left"));
  EXPECT_EQ(what.number("wrong_left"), 0);
  EXPECT_EQ(what.number("wrong_right"), width - 1);
  EXPECT_EQ(what.number("wrong_bottom"), height - 1);
  EXPECT_FALSE(observed(truth, truth, filled(0.0625F)).numbers.contains("wrong_left"));
}

}  // namespace
}  // namespace triptych::judge
