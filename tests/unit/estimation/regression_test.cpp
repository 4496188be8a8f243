// Fits lines to data sets for which the results have been published.

#include "estimation/regression.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace triptych::estimation {
namespace {

using Values = std::vector<double>;

// Anscombe (1973), "Graphs in Statistical Analysis", tables: four data sets with the same
// least-squares line.
const Values anscombe_x{10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
const Values anscombe_x4{8, 8, 8, 8, 8, 8, 8, 19, 8, 8, 8};
const std::array<Values, 4> anscombe_y{
    Values{8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68},
    Values{9.14, 8.14, 8.74, 8.77, 9.26, 8.10, 6.13, 3.10, 9.13, 7.26, 4.74},
    Values{7.46, 6.77, 12.74, 7.11, 7.81, 8.84, 6.08, 5.39, 8.15, 6.42, 5.73},
    Values{6.58, 5.76, 7.71, 8.84, 8.47, 7.04, 5.25, 12.50, 5.56, 7.91, 6.89}};

// Rousseeuw & Leroy (1987), "Robust Regression and Outlier Detection", table 3: logarithms of the
// temperature and luminosity of 47 stars in the direction of Cygnus, four of which are giants.
const Values star_temperature{
    4.37, 4.56, 4.26, 4.56, 4.30, 4.46, 3.84, 4.57, 4.26, 4.37, 3.49, 4.43, 4.48, 4.01, 4.29, 4.42,
    4.23, 4.42, 4.23, 3.49, 4.29, 4.29, 4.42, 4.49, 4.38, 4.42, 4.29, 4.38, 4.22, 3.48, 4.38, 4.56,
    4.45, 3.49, 4.23, 4.62, 4.53, 4.45, 4.53, 4.43, 4.38, 4.45, 4.50, 4.45, 4.55, 4.45, 4.42};
const Values star_luminosity{5.23, 5.74, 4.93, 5.74, 5.19, 5.46, 4.65, 5.27, 5.57, 5.12, 5.73, 5.45,
                             5.42, 4.05, 4.26, 4.58, 3.94, 4.18, 4.18, 5.89, 4.38, 4.22, 4.42, 4.85,
                             5.02, 4.66, 4.66, 4.90, 4.39, 6.05, 4.42, 5.10, 5.22, 6.29, 4.34, 5.62,
                             5.10, 5.22, 5.18, 5.57, 4.62, 5.06, 5.34, 5.34, 5.54, 4.98, 4.50};

// Rousseeuw & Leroy (1987), table 1: international calls from Belgium in tens of millions, 1950 to
// 1973. For six of these years, minutes were reported instead of calls.
const Values phone_calls{0.44, 0.47, 0.47, 0.59, 0.66, 0.73, 0.81, 0.88, 1.06, 1.20, 1.35, 1.49,
                         1.61, 2.12, 11.9, 12.4, 14.2, 15.9, 18.2, 21.2, 4.30, 2.40, 2.70, 2.90};
Values call_years() {
  Values years;
  for (int year = 50; year <= 73; ++year) years.push_back(year);
  return years;
}

TEST(LeastSquares, FitsTheSameLineToAnscombesFourSets) {
  for (std::size_t set = 0; set < anscombe_y.size(); ++set) {
    const auto& x = set == 3 ? anscombe_x4 : anscombe_x;
    const LeastSquares fit = least_squares(x, anscombe_y[set]);
    EXPECT_NEAR(fit.line.intercept, 3.00, 0.005) << set;
    EXPECT_NEAR(fit.line.slope, 0.500, 0.0005) << set;
    EXPECT_NEAR(pearson_r(x, anscombe_y[set]), 0.816, 0.0011) << set;
    EXPECT_NEAR(fit.slope_error, 0.118, 0.0005) << set;  // the value given by Anscombe
  }
}

TEST(LeastSquares, IsAffectedByOutliers) {
  // Rousseeuw & Leroy, chapter 2: −0.413 and 6.793 for the stars, 0.504 and −26.01 for the calls.
  const Line stars = least_squares(star_temperature, star_luminosity).line;
  EXPECT_NEAR(stars.slope, -0.413, 0.0005);
  EXPECT_NEAR(stars.intercept, 6.793, 0.0006);
  const Line phone = least_squares(call_years(), phone_calls).line;
  EXPECT_NEAR(phone.slope, 0.504, 0.0005);
  EXPECT_NEAR(phone.intercept, -26.01, 0.005);
}

TEST(RobustLine, FollowsTheMainSequenceOfTheStars) {
  // The expected values are MM-estimates for the data set starsCYG, computed by R's package
  // robustbase with the two bisquare functions that robust_line() also uses.
  const RobustLine fit = robust_line(star_temperature, star_luminosity);
  EXPECT_NEAR(fit.line.slope, 2.253, 0.001);
  EXPECT_NEAR(fit.line.intercept, -4.969, 0.005);
  EXPECT_NEAR(fit.scale, 0.4715, 0.0005);
  for (const std::size_t giant : {10U, 19U, 29U, 33U}) {
    EXPECT_EQ(fit.weights[giant], 0) << giant;
    EXPECT_GT(fit.residuals[giant], 5 * fit.scale) << giant;
  }
}

TEST(RobustLine, IgnoresTheYearsInMinutes) {
  // Venables & Ripley (2002), "Modern Applied Statistics with S", section 6.5: MM-estimates of
  // 1.1009 and −52.42 if calls are counted in millions. Here, the unit is ten million calls.
  const RobustLine fit = robust_line(call_years(), phone_calls);
  EXPECT_NEAR(fit.line.slope, 0.1101, 0.0002);
  EXPECT_NEAR(fit.line.intercept, -5.242, 0.01);
  for (std::size_t i = 14; i < 20; ++i) EXPECT_EQ(fit.weights[i], 0) << i;
}

TEST(RobustLine, IsLeastSquaresWithoutOutliers) {
  // A line with small deviations that show no trend.
  Values x;
  Values y;
  for (int i = 0; i < 20; ++i) {
    x.push_back(i);
    y.push_back(3 + 0.5 * i + 0.1 * std::sin(2.4 * i));
  }
  const RobustLine robust = robust_line(x, y);
  const LeastSquares ordinary = least_squares(x, y);
  EXPECT_NEAR(robust.line.slope, ordinary.line.slope, 0.3 * ordinary.slope_error);
  EXPECT_NEAR(robust.slope_error, ordinary.slope_error, 0.25 * ordinary.slope_error);
  double sum = 0;
  for (const double h : robust.leverages) sum += h;
  EXPECT_NEAR(sum, 2, 0.2);  // the number of parameters, changed slightly by the weights
}

TEST(RobustLine, AnExactLineHasNoScale) {
  Values x{1, 2, 3, 4, 5, 6, 7, 8};
  Values y{3, 5, 7, 9, 11, 13, 40, -8};
  const RobustLine fit = robust_line(x, y);
  EXPECT_NEAR(fit.line.slope, 2, 1e-12);
  EXPECT_NEAR(fit.line.intercept, 1, 1e-12);
  EXPECT_EQ(fit.scale, 0);
  EXPECT_EQ(fit.slope_error, 0);
  EXPECT_EQ(fit.weights[6], 0);
  EXPECT_EQ(fit.weights[0], 1);
}

TEST(RobustLine, WithstandsAlmostHalfOutliers) {
  Values x;
  Values y;
  for (int i = 0; i < 100; ++i) {
    x.push_back(0.05 * i);
    const bool is_outlier = i % 20 < 9;  // 45 % of the points are outliers
    y.push_back(is_outlier ? 20 - 3 * x.back() : 1 + 1.1 * x.back() + 0.02 * std::sin(37.0 * i));
  }
  const RobustLine fit = robust_line(x, y);
  EXPECT_NEAR(fit.line.slope, 1.1, 0.01);
  EXPECT_NEAR(fit.line.intercept, 1, 0.02);
}

TEST(Lines, TheilAndSenFindTheSlope) {
  Values x;
  Values y;
  for (int i = 0; i < 26; ++i) {  // there are 325 pairs, so the median slope is that of one pair
    x.push_back(0.2 * i + 0.03 * std::cos(5.0 * i));
    y.push_back(0.4 + 0.18 * i + 0.03 * std::sin(9.0 * i));
  }
  EXPECT_NEAR(theil_sen(x, y).slope, 0.9, 0.02);
}

TEST(Lines, PearsonOfOppositesIsMinusOne) {
  const Values x{1, 2, 3, 4};
  const Values y{4, 3, 2, 1};
  EXPECT_NEAR(pearson_r(x, y), -1, 1e-15);
  EXPECT_TRUE(std::isnan(pearson_r(x, Values{1, 1, 1, 1})));
}

TEST(Lines, RejectDataWithoutALine) {
  EXPECT_THROW((void)robust_line(Values{1, 2, 3}, Values{1, 2, 3}), core::InputError);
  EXPECT_THROW((void)robust_line(Values{1, 1, 1, 1}, Values{1, 2, 3, 4}), core::InputError);
  EXPECT_THROW((void)robust_line(Values{1, 2, 3, NAN}, Values{1, 2, 3, 4}), core::InputError);
  EXPECT_THROW((void)robust_line(Values{1, 2, 3, 4}, Values{1, 2, 3}), core::InputError);
  EXPECT_TRUE(std::isnan(least_squares(Values{1, 1, 1}, Values{1, 2, 3}).line.slope));
  EXPECT_TRUE(std::isnan(least_squares(Values{1, 2}, Values{1, 2}).slope_error));
}

}  // namespace
}  // namespace triptych::estimation
