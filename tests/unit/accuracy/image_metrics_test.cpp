#include "accuracy/image_metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace triptych::accuracy {
namespace {

core::Image filled(int width, int height, float value) {
  core::Image image(width, height);
  for (float& v : image.rgba) v = value;
  return image;
}

float& channel(core::Image& image, int x, int y, int c) {
  return image.rgba[static_cast<std::size_t>(4 * (y * image.width + x) + c)];
}

TEST(ImageMetrics, EqualImagesHaveNoError) {
  const core::Image image = filled(4, 3, 0.5F);
  const ImageComparison result = compare(image, image, 0.0);
  EXPECT_TRUE(result.within_bound());
  EXPECT_EQ(result.pixels, 12U);
  EXPECT_EQ(result.rmse, 0);
  EXPECT_EQ(result.worst.ratio, 0);
}

// The pixel with the largest error is not the pixel with the largest ratio of error to bound.
TEST(ImageMetrics, FindsTheWorstPixelRelativeToItsBound) {
  const core::Image truth = filled(4, 3, 0.0F);
  core::Image image = truth;
  core::Image bound = filled(4, 3, 0.5F);
  channel(image, 1, 2, 0) = 0.25F;
  channel(image, 3, 0, 2) = -0.125F;
  for (int c = 0; c < 4; ++c) channel(bound, 3, 0, c) = 0.0625F;
  const ImageComparison result = compare(image, truth, bound);
  EXPECT_FALSE(result.within_bound());
  EXPECT_EQ(result.over_bound, 1U);
  EXPECT_EQ(result.largest.x, 1);
  EXPECT_EQ(result.largest.y, 2);
  EXPECT_EQ(result.largest.error, 0.25);
  EXPECT_EQ(result.worst.x, 3);
  EXPECT_EQ(result.worst.y, 0);
  EXPECT_EQ(result.worst.ratio, 2);
  EXPECT_DOUBLE_EQ(result.rmse, std::sqrt((0.0625 + 0.015625) / 48));
  EXPECT_TRUE(compare(image, truth, bound, 0.0625).within_bound()) << "slack widens every bound";
}

TEST(ImageMetrics, CountsNonFinitePixels) {
  core::Image image = filled(2, 2, 0.0F);
  channel(image, 0, 1, 3) = std::numeric_limits<float>::quiet_NaN();
  channel(image, 1, 1, 0) = std::numeric_limits<float>::infinity();
  const ImageComparison result = compare(image, filled(2, 2, 0.0F), 1.0);
  EXPECT_EQ(result.non_finite, 2U);
  EXPECT_EQ(result.over_bound, 0U);
  EXPECT_FALSE(result.within_bound());
}

TEST(ImageMetrics, FindsTheRectangleOfWrongPixels) {
  const core::Image truth = filled(8, 6, 0.5F);
  core::Image image = truth;
  EXPECT_EQ(compare(image, truth, 0.125).wrong_area.left, -1);
  channel(image, 5, 1, 0) = 1.0F;
  channel(image, 2, 4, 3) = std::nanf("");
  channel(image, 3, 2, 1) = 0.5625F;  // within the bound
  const auto& [left, top, right, bottom] = compare(image, truth, 0.125).wrong_area;
  EXPECT_EQ(left, 2);
  EXPECT_EQ(top, 1);
  EXPECT_EQ(right, 5);
  EXPECT_EQ(bottom, 4);
}

// Before each frame, all channels of all pixels are set to NaN.
TEST(ImageMetrics, PixelsThatAreNaNInAllChannelsWereNotDrawn) {
  const core::Image truth = filled(4, 3, 0.5F);
  core::Image image = truth;
  for (int c = 0; c < 4; ++c) channel(image, 3, 0, c) = std::nanf("");
  channel(image, 1, 1, 2) = std::nanf("");
  const ImageComparison result = compare(image, truth, 0.125);
  EXPECT_EQ(result.non_finite, 2U);
  EXPECT_EQ(result.not_drawn, 1U);
}

TEST(ImageMetrics, NothingIsWithinABoundThatIsNotANumber) {
  const core::Image image = filled(1, 1, 0.0F);
  const auto bound = filled(1, 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(compare(image, image, bound).over_bound, 1U);
}

TEST(ImageMetrics, SizesMustMatch) {
  EXPECT_TRUE(compare(filled(2, 3, 0), filled(3, 2, 0), 1.0).size_mismatch);
  EXPECT_TRUE(compare(filled(2, 2, 0), filled(2, 2, 0), filled(1, 1, 0)).size_mismatch);
  EXPECT_TRUE(std::isnan(root_mean_square(filled(2, 3, 0), filled(3, 2, 0))));
}

// Returns an image of four pixels: particles 7 and 8 at depths 2 and 3, then an empty pixel, then
// particle 9, for which particle_bound() states that the reference is uncertain.
core::Image particles() {
  core::Image image = filled(4, 1, 0.5F);
  constexpr float none = std::numeric_limits<float>::infinity();
  image.ids = {7, 8, core::Image::no_particle, 9};
  image.depth = {2, 3, none, 4};
  return image;
}

core::Image particle_bound() {
  core::Image bound = filled(4, 1, 0.0F);
  bound.ids = {0, 0, 0, core::Image::no_particle};
  bound.depth = {0.5F, 0.5F, 0, std::numeric_limits<float>::infinity()};
  return bound;
}

TEST(ImageMetrics, ParticlesAreComparedByIdAndDepth) {
  core::Image image = particles();
  EXPECT_TRUE(compare(image, particles(), particle_bound()).within_bound());
  image.depth[1] = 3.25F;
  EXPECT_TRUE(compare(image, particles(), particle_bound()).within_bound())
      << "the depth is within its bound";
  image.depth[1] = 3.75F;
  ImageComparison result = compare(image, particles(), particle_bound());
  EXPECT_FALSE(result.within_bound());
  EXPECT_EQ(result.wrong_depths, 1U);
  EXPECT_EQ(result.first_wrong.x, 1);
  image = particles();
  image.ids[0] = 8;
  result = compare(image, particles(), particle_bound());
  EXPECT_FALSE(result.within_bound());
  EXPECT_EQ(result.wrong_ids, 1U);
  EXPECT_EQ(result.first_wrong.expected_id, 7U);
}

TEST(ImageMetrics, ALostAndAnInventedParticleAreWrong) {
  core::Image image = particles();
  image.ids[0] = core::Image::no_particle;
  image.depth[0] = std::numeric_limits<float>::infinity();
  image.ids[2] = 7;
  image.depth[2] = 2;
  EXPECT_EQ(compare(image, particles(), particle_bound()).wrong_ids, 2U);
}

TEST(ImageMetrics, DepthThatIsNotANumberIsWrong) {
  core::Image image = particles();
  image.depth[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(compare(image, particles(), particle_bound()).wrong_depths, 1U);
}

TEST(ImageMetrics, AnUncertainPixelIsJudgedByItsColour) {
  core::Image image = particles();
  image.ids[3] = 7;
  image.depth[3] = 1;
  EXPECT_TRUE(compare(image, particles(), particle_bound()).within_bound());
  channel(image, 3, 0, 0) = 1;
  EXPECT_FALSE(compare(image, particles(), particle_bound()).within_bound());
  EXPECT_GT(root_mean_square(image, particles()), 0);
  EXPECT_EQ(root_mean_square(image, particles(), particle_bound()), 0);
}

TEST(ImageMetrics, AnImageWithoutIdsIsNotAParticleImage) {
  EXPECT_TRUE(compare(filled(4, 1, 0.5F), particles(), particle_bound()).size_mismatch);
}

TEST(ImageMetrics, EmptyImagesDoNotPass) {
  EXPECT_FALSE(compare(core::Image(), core::Image(), 1.0).within_bound());
}

TEST(ImageMetrics, NinetyNinthPercentile) {
  const core::Image truth = filled(101, 1, 0.0F);
  core::Image image = truth;
  for (int x = 0; x < 101; ++x) channel(image, x, 0, 1) = static_cast<float>(x) / 128;
  EXPECT_DOUBLE_EQ(compare(image, truth, 1.0).error_99, 99.0 / 128);
}

}  // namespace
}  // namespace triptych::accuracy
