// Tests the line that relates the costs of two devices, and the conditions under which the line is
// meaningful.

#include <gmock/gmock.h>

#include <cmath>

#include "judge/correlation/line.hpp"

namespace triptych::judge {
namespace {

// Returns points on y = 0.7 + slope·x, plus a wave of the given amplitude.
CorrelationPair pair_of(std::size_t points, double slope = 1, double wave = 0.02) {
  CorrelationPair pair{.device_a = "a", .device_b = "b", .signal = "cost"};
  for (std::size_t i = 0; i < points; ++i) {
    const double x = 14 + 0.05 * static_cast<double>(i);
    const double y = 0.7 + slope * x + wave * std::sin(1.7 * static_cast<double>(i));
    pair.points.push_back({.configuration = std::to_string(i), .x = x, .y = y});
  }
  return pair;
}

CorrelationLine line_of(CorrelationPair pair) {
  fit_line(pair);
  return pair.line;
}

TEST(FitLine, RecoversAKnownLine) {
  CorrelationPair pair = pair_of(40, 1.1, 0);
  pair.points[3].y += 5;
  fit_line(pair);
  EXPECT_NEAR(pair.line.slope, 1.1, 1e-9);
  EXPECT_NEAR(pair.line.intercept, 0.7, 1e-7);
  EXPECT_NEAR(pair.points[3].residual, 5, 1e-7);
}

TEST(FitLine, RequiresEnoughPointsAndLittleScatter) {
  EXPECT_TRUE(line_of(pair_of(20)).admitted()) << name_of(line_of(pair_of(20)).refusal);
  EXPECT_EQ(line_of(pair_of(19)).refusal, LineRefusal::too_few_configurations);
  EXPECT_EQ(line_of(pair_of(40, 1.4)).refusal, LineRefusal::slope_out_of_range);
  EXPECT_EQ(line_of(pair_of(40, 0.6)).refusal, LineRefusal::slope_out_of_range);
  EXPECT_EQ(line_of(pair_of(40, 1, 2)).refusal, LineRefusal::low_correlation);
  EXPECT_EQ(line_of(pair_of(80, 1, 0.5)).refusal, LineRefusal::large_scatter);
}

TEST(FitLine, TooFewPointsHaveNoLine) {
  for (const std::size_t points : {0U, 1U, 3U}) {
    const CorrelationLine line = line_of(pair_of(points));
    EXPECT_FALSE(line.admitted());
    EXPECT_TRUE(std::isnan(line.slope));
  }
  CorrelationPair equal_x = pair_of(30);
  for (CorrelationPoint& point : equal_x.points) point.x = 14;
  EXPECT_FALSE(line_of(equal_x).admitted());
}

// If all configurations with one level of a factor are off the fitted line by far more than the
// scatter, the level is reported as one finding instead of many outliers. All other configurations
// are still compared with the line.
TEST(LineOutliers, ALevelAndOneConfiguration) {
  CorrelationPair pair = pair_of(60);
  std::vector<Factors> factors;
  for (std::size_t i = 0; i < pair.points.size(); ++i) {
    factors.push_back({{"data", std::to_string(i % 3)}, {"step", std::to_string(i / 30)}});
    if (i % 3 == 1) pair.points[i].y += 0.4;
  }
  pair.points[5].y += 0.3;
  const auto outliers = line_outliers(pair.points, factors);
  ASSERT_EQ(outliers.size(), 2U);
  EXPECT_EQ(outliers[0].level, "data=1");
  EXPECT_NEAR(outliers[0].effect, 0.4, 0.01);
  EXPECT_LT(outliers[0].error, 0.01);
  EXPECT_EQ(outliers[1].level, "");
  EXPECT_EQ(outliers[1].members, std::vector<std::size_t>{5});
  EXPECT_NEAR(outliers[1].effect, 0.3, 0.03);
}

TEST(LineOutliers, AnExactLineFindsOutliers) {
  CorrelationPair pair = pair_of(40, 1, 0);
  pair.points[7].y += 0.11;
  const auto outliers = line_outliers(pair.points, std::vector<Factors>(40));
  ASSERT_EQ(outliers.size(), 1U);
  EXPECT_EQ(outliers[0].members, std::vector<std::size_t>{7});
}

}  // namespace
}  // namespace triptych::judge
