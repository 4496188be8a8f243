// Tests orders of convergence, Pareto fronts and times to an error with numbers whose results are
// known.

#include "accuracy/accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace triptych::accuracy {
namespace {

std::vector<StepError> errors_by(const std::vector<double>& steps,
                                 const std::function<double(double)>& error,
                                 double arithmetic = 0) {
  std::vector<StepError> points;
  for (const double step : steps) points.push_back({step, error(step), arithmetic});
  return points;
}

const std::vector<double> halvings{2, 1, 0.5, 0.25, 0.125, 0.0625};

AccuracyCase step_case(double time, double rmse, double step = 1, const std::string& ert = "0") {
  return {.configuration = {},
          .factors = {{"step", step == 1 ? "1" : std::to_string(step)}, {"ert", ert}},
          .time_ns = time,
          .samples = {},
          .instructions = {},
          .fetched = {},
          .memory = {},
          .joules = {},
          .rmse = rmse};
}

TEST(FitOrder, FindsTheOrderAndItsInterval) {
  const auto exact = fit_order(errors_by(halvings, [](double h) { return 0.3 * h * h; }));
  ASSERT_TRUE(exact);
  EXPECT_NEAR(exact->order, 2, 1e-12);
  EXPECT_NEAR(exact->half_width, 0, 1e-6);
  const auto first = fit_order(errors_by(halvings, [](double h) { return 0.3 * h; }));
  EXPECT_NEAR(first->order, 1, 1e-12);
}

// The expected interval was computed by hand for the errors e of four step sizes h, with ln e =
// 2·ln h + d. The deviations d are −0.1 and 0.1 in turn. With x = ln h, whose mean is x̄, the slope
// deviates from 2 by Σ(x − x̄)d/Σ(x − x̄)², and the half width is t₀.₉₇₅(2) = 4.3027 standard
// errors.
TEST(FitOrder, TheIntervalUsesStudentsT) {
  const std::vector<double> steps{1, 0.5, 0.25, 0.125};
  double sign = 0.1;
  const auto order = fit_order(errors_by(steps, [&](double h) {
    sign = -sign;
    return h * h * std::exp(sign);
  }));
  ASSERT_TRUE(order);
  // In units of ln 2, the values of x − x̄ are 1.5, 0.5, −0.5 and −1.5. The values of d are −0.1,
  // 0.1, −0.1 and 0.1.
  const double shift = (1.5 * -0.1 + 0.5 * 0.1 + -0.5 * -0.1 + -1.5 * 0.1) / 5 / std::log(2.0);
  EXPECT_NEAR(order->order, 2 + shift, 1e-12);
  const double residual = 4 * 0.01 - 5 * std::pow(shift * std::log(2.0), 2);
  const double error = std::sqrt(residual / 2 / 5) / std::log(2.0);
  EXPECT_NEAR(order->half_width, 4.302653 * error, 1e-5);
}

TEST(FitOrder, StepsLongerThanAVoxelAreIgnored) {
  auto points = errors_by(halvings, [](double h) { return h * h; });
  points.front().error = 1e3;
  const auto order = fit_order(points);
  ASSERT_TRUE(order);
  EXPECT_NEAR(order->order, 2, 1e-12);
  EXPECT_EQ(order->points, 5U);
}

// If a rounding error f is added to the step-size error s, the measured error is √(s² + f²). The
// fit must leave out points that consist mainly of f, because they would reduce the order.
TEST(FitOrder, RoundingDoesNotReduceTheOrder) {
  const double floor = 1e-4;
  const auto order = fit_order(errors_by(
      halvings, [&](double h) { return std::hypot(0.1 * h * h, floor); }, floor));
  ASSERT_TRUE(order);
  EXPECT_EQ(order->points, 4U);  // the fit uses the errors 0.1, 0.025, 0.006 and 0.0016
  EXPECT_NEAR(order->order, 2, 0.005);
  EXPECT_FALSE(fit_order(errors_by(
      halvings, [&](double) { return floor; }, floor)));
}

TEST(FitOrder, TwoPointsAreNotEnough) {
  EXPECT_FALSE(fit_order(errors_by({1, 0.5}, [](double h) { return h * h; })));
  EXPECT_FALSE(fit_order(errors_by(halvings, [](double) { return 0.0; })));
}

TEST(Front, ContainsTheCasesThatAreNotDominated) {
  const std::vector<AccuracyCase> cases{step_case(1, 8), step_case(2, 4), step_case(3, 5),
                                        step_case(4, 2), step_case(4, 2), step_case(2, 6)};
  const auto front = pareto_front(cases);
  EXPECT_EQ(front, (std::vector<std::size_t>{0, 1, 3}));
  const auto dominated_cases = dominated(cases, front);
  ASSERT_EQ(dominated_cases.size(), 2U);  // a case that equals a case on the front is not dominated
  EXPECT_EQ(dominated_cases[0].index, 2U);
  EXPECT_EQ(dominated_cases[0].by, 1U);
  EXPECT_EQ(dominated_cases[1].index, 5U);
  EXPECT_EQ(dominated_cases[1].by, 1U);
}

TEST(Families, DifferOnlyInTheStep) {
  const std::vector<AccuracyCase> cases{step_case(1, 1, 0.5, "0"), step_case(1, 1, 1, "0"),
                                        step_case(1, 1, 1, "0.1")};
  const auto families = accuracy_families(cases);
  ASSERT_EQ(families.size(), 2U);
  EXPECT_EQ(families[0].name, "ert=0");
  EXPECT_EQ(families[0].members, (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(families[1].name, "ert=0.1");
}

TEST(TimeToError, IsStraightOnLogarithmicAxes) {
  // Time is proportional to 1/step and the error to step², so the error is proportional to time⁻².
  // A quarter of the error therefore takes twice the time.
  const std::vector<AccuracyCase> cases{step_case(1, 1e-2, 1), step_case(4, 1e-2 / 16, 0.25)};
  const auto families = accuracy_families(cases);
  EXPECT_NEAR(*time_to_error(cases, families, 1e-2 / 4), 2, 1e-12);
  EXPECT_EQ(*time_to_error(cases, families, 0.1), 1);  // the first case is already the fastest
  EXPECT_FALSE(time_to_error(cases, families, 1e-4));
}

TEST(TimeToError, DoesNotInterpolateBetweenFamilies) {
  const std::vector<AccuracyCase> cases{step_case(1, 1e-2, 1, "0"), step_case(4, 1e-4, 1, "0.1")};
  EXPECT_EQ(*time_to_error(cases, accuracy_families(cases), 1e-3), 4);
}

TEST(SwitchedAlone, ChangesOneFactor) {
  const std::vector<AccuracyCase> cases{step_case(9, 1, 0.5, "0"), step_case(5, 2, 1, "0"),
                                        step_case(5, 3, 0.5, "0.1"), step_case(5, 4, 1, "0.1")};
  EXPECT_EQ(most_accurate(cases), 0U);
  const auto switched = single_factor_switches(cases);
  ASSERT_EQ(switched.size(), 2U);
  EXPECT_EQ(switched[0].factor, "ert");
  EXPECT_EQ(switched[0].from, 0U);
  EXPECT_EQ(switched[0].to, 2U);
  EXPECT_EQ(switched[1].factor, "step");
  EXPECT_EQ(switched[1].from, 0U);
  EXPECT_EQ(switched[1].to, 1U);
}

// The level ert=0.1 was measured only with step 1. It is therefore compared with the best case that
// has the same step, not with the most accurate case, which has step 0.5.
TEST(SwitchedAlone, UsesTheBestCaseWithACounterpart) {
  const std::vector<AccuracyCase> cases{step_case(9, 1, 0.5, "0"), step_case(5, 2, 1, "0"),
                                        step_case(5, 4, 1, "0.1")};
  const auto switched = single_factor_switches(cases);
  ASSERT_EQ(switched.size(), 2U);
  EXPECT_EQ(switched[0].factor, "ert");
  EXPECT_EQ(switched[0].from, 1U);
  EXPECT_EQ(switched[0].to, 2U);
}

TEST(SwitchedBetween, FindsTheCounterpartInAnotherScene) {
  std::vector<AccuracyCase> cases{step_case(9, 1, 0.5), step_case(5, 2, 1)};
  std::vector<AccuracyCase> others{step_case(5, 3, 1), step_case(9, 4, 0.25)};
  for (AccuracyCase& each : cases) each.factors["viewport"] = "48";
  for (AccuracyCase& each : others) each.factors["viewport"] = "96";
  const auto found = factor_switch_between(cases, others, "viewport");
  ASSERT_TRUE(found);
  // The most accurate case has step 0.5, which the other scene lacks. Therefore the cases with step
  // 1 are chosen.
  EXPECT_EQ(found->from, 1U);
  EXPECT_EQ(found->to, 0U);
  EXPECT_FALSE(factor_switch_between(cases, others, "step"));
}

// Errors and orders need no times. Fronts and times to an error contain only cases that have times.
TEST(Untimed, HasOrdersButNoFront) {
  std::vector<AccuracyCase> cases;
  for (const double step : {1.0, 0.5, 0.25}) cases.push_back(step_case(1, 0.1 * step * step, step));
  for (AccuracyCase& each : cases) each.time_ns.reset();
  const auto families = accuracy_families(cases);
  ASSERT_EQ(families.size(), 1U);
  ASSERT_TRUE(families[0].order);
  EXPECT_NEAR(families[0].order->order, 2, 1e-12);
  EXPECT_TRUE(pareto_front(cases).empty());
  EXPECT_TRUE(dominated(cases, {}).empty());
  EXPECT_FALSE(time_to_error(cases, families, 1));
  EXPECT_EQ(most_accurate(cases), 2U);
  cases.push_back(step_case(7, 0.05, 2));
  EXPECT_EQ(pareto_front(cases), (std::vector<std::size_t>{3}));
}

}  // namespace
}  // namespace triptych::accuracy
