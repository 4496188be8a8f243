// Tests the search for the longest step size and for the fastest case that meet a requested error.

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "accuracy/choice.hpp"
#include "accuracy/requested_error.hpp"
#include "core/error.hpp"

namespace triptych::accuracy {
namespace {

TEST(LongestStep, OfASecondOrderErrorIsWithinAQuarterOctave) {
  for (const double error : {1e-2, 1e-3, 3e-5}) {
    int calls = 0;
    const auto found = longest_step(error, {}, [&](double step) {
      ++calls;
      return 2e-3 * step * step;
    });
    EXPECT_LE(found.error, error);
    EXPECT_GE(found.error, error / std::sqrt(2.0) * 0.999);
    EXPECT_DOUBLE_EQ(found.error, 2e-3 * found.step * found.step);
    EXPECT_LE(calls, 14);
  }
}

TEST(LongestStep, IsNotAnAccidentalMinimum) {
  // At a step size of 4 voxels, the error is small by chance. Only below 1 voxel does it follow its
  // asymptotic order.
  const auto found =
      longest_step(1e-3, {}, [](double step) { return step == 4 ? 1e-4 : 2e-3 * step * step; });
  EXPECT_LT(found.step, 1);
}

TEST(LongestStep, OfAnExactRuleIsTheLongestOfAll) {
  const auto found =
      longest_step(1e-6, {.shortest = 0.25, .longest = 64}, [](double) { return 0; });
  EXPECT_EQ(found.step, 64);
}

TEST(LongestStep, IsAbsentIfTheShortestIsNotEnough) {
  const auto found = longest_step(1e-9, {}, [](double step) { return step; });
  EXPECT_EQ(found.step, 1.0 / 64);
  EXPECT_EQ(found.error, 1.0 / 64);
  EXPECT_FALSE(longest_step(1e-3, {}, [](double) { return std::nan(""); }).error <= 1e-3);
}

TEST(SearchSize, KeepsRaysOnBothAxes) {
  const auto size = [](int width, int height) {
    const ImageSize found = search_size({width, height});
    return std::pair(found.width, found.height);
  };
  EXPECT_EQ(size(48, 48), std::pair(48, 48));
  EXPECT_EQ(size(1024, 1024), std::pair(48, 48));
  EXPECT_EQ(size(1920, 1080), std::pair(64, 36));
  EXPECT_EQ(size(1024, 16), std::pair(288, 8));
  EXPECT_EQ(size(16, 1024), std::pair(8, 288));
  EXPECT_EQ(size(100000, 3), std::pair(768, 3));
  EXPECT_EQ(size(3, 5), std::pair(3, 5));
  EXPECT_EQ(size(1, 1), std::pair(1, 1));
}

TEST(Cheapest, IsTheFastestThatMeetsTheError) {
  const std::vector<TimedError> cases{{1, 1e-2}, {5, 1e-3}, {4, 9e-4}, {9, 1e-6}, {{}, 1e-9}};
  EXPECT_EQ(cheapest(cases, 1e-2), 0U);
  EXPECT_EQ(cheapest(cases, 1e-3), 2U);
  EXPECT_EQ(cheapest(cases, 1e-5), 3U);
  EXPECT_EQ(cheapest(cases, 1e-9), std::nullopt);
}

TEST(RequestedError, IsParsedWithItsMetric) {
  EXPECT_EQ(parse_requested_error("1e-3").metric, Metric::rms);
  EXPECT_EQ(text_of(parse_requested_error("1e-3:max")), "0.001:max");
  EXPECT_EQ(parse_requested_error("0.25:p99.9").metric, Metric::p99_9);
  for (const char* wrong :
       {"", "0", "-1", "nan", "inf", "1e-3x", "1e-3:", ":max", "1e-3:largest"}) {
    EXPECT_THROW(static_cast<void>(parse_requested_error(wrong)), core::InputError) << wrong;
  }
}

TEST(ErrorsByMetric, ContainEveryMetric) {
  core::Image limit(100, 20);
  core::Image image = limit;
  for (std::size_t i = 0; i < 20; ++i) limit.rgba[4 * i] = 0.5F;
  // The first pixel has an error of 0.5, because it is 1 instead of 0.5. The next 19 pixels have
  // the same error, because they are 0 instead of 0.5.
  image.rgba[0] = 1.0F;
  const ErrorsByMetric errors = errors_against(limit, image);
  EXPECT_EQ(errors.covered, 20U);
  EXPECT_DOUBLE_EQ(errors.of(Metric::max), 0.5);
  EXPECT_DOUBLE_EQ(errors.of(Metric::p99_9), 0.5);
  EXPECT_DOUBLE_EQ(errors.of(Metric::rms), 0.5 * std::sqrt(20 / 8000.0));
  EXPECT_DOUBLE_EQ(errors.of(Metric::covered), 0.25);
  EXPECT_DOUBLE_EQ(errors_of_empty_image(limit).of(Metric::covered), 0.25);
  EXPECT_EQ(errors_of_empty_image(core::Image(3, 3)).of(Metric::covered), 0);
  image.rgba[7] = std::nanf("");
  EXPECT_TRUE(std::isnan(errors_against(limit, image).of(Metric::rms)));
  EXPECT_TRUE(std::isnan(errors_against(limit, core::Image(3, 3)).of(Metric::max)));
}

}  // namespace
}  // namespace triptych::accuracy
