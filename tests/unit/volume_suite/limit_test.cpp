// Compares limit images with closed-form solutions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "measure/plan/plan.hpp"
#include "suites/volume/analytic_data.hpp"
#include "suites/volume/suite.hpp"

namespace triptych::volume_suite {
namespace {

measure::Configuration limited_configuration(const measure::Suite& suite, const std::string& data) {
  measure::Configuration configuration = measure::default_plan(suite, {}).configurations.front();
  configuration["data"] = data;
  configuration["transfer_function"] = own_transfer_function;
  configuration["camera"] = "orbit_y:1/9";
  configuration["viewport"] = "24";
  return configuration;
}

double largest_difference(const core::Image& a, const core::Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a.rgba[i] - b.rgba[i])));
  }
  return largest;
}

// According to the model in analytic_scenes.hpp, the transfer function table represents the ramp
// with an error below 4e-5.
TEST(Limit, OfARampMatchesTheClosedForm) {
  const auto suite = make_suite({});
  const measure::Configuration ramp = limited_configuration(*suite, "analytic:v2_ramp:16");
  const measure::Limit limit = suite->limit(ramp);
  const auto exact = suite->closed_form(ramp);
  ASSERT_TRUE(exact);
  ASSERT_EQ(limit.image.rgba.size(), exact->rgba.size());
  EXPECT_LT(largest_difference(limit.image, *exact), 4e-5);
  EXPECT_GT(*std::ranges::max_element(limit.image.rgba), 0.3F);  // the image is not empty
  EXPECT_LT(*std::ranges::max_element(limit.uncertainty.rgba), 1e-7F);
}

TEST(Limit, DiffersFromACoarseStep) {
  const auto suite = make_suite({});
  measure::Configuration ramp = limited_configuration(*suite, "analytic:v2_ramp:16");
  ramp["step"] = "2";
  const accuracy::TruthPair truth = suite->truth(ramp, {});
  EXPECT_GT(largest_difference(suite->limit(ramp).image, truth.truth), 1e-3);
}

TEST(Limit, DoesNotDependOnStepOrStorage) {
  const auto suite = make_suite({});
  measure::Configuration a = limited_configuration(*suite, "analytic:v4_gaussian:8");
  measure::Configuration b = a;
  b["step"] = "0.25";
  b["voxel"] = "u8";
  b["ert"] = "0";
  EXPECT_EQ(suite->limit_key(a), suite->limit_key(b));
  b["camera"] = "orbit_y:2/9";
  EXPECT_NE(suite->limit_key(a), suite->limit_key(b));
}

TEST(Limit, OnlyAnUnmodifiedProblemHasAClosedForm) {
  const auto suite = make_suite({});
  measure::Configuration ramp = limited_configuration(*suite, "analytic:v2_ramp:8");
  ramp["transfer_function"] = "haze";
  EXPECT_FALSE(suite->closed_form(ramp));
  EXPECT_FALSE(suite->closed_form(limited_configuration(*suite, "generate:uniform_box:8")));
}

TEST(AnalyticData, NamesAProblemAndASize) {
  EXPECT_FALSE(analytic_data("generate:uniform_box:8"));
  const auto layers = analytic_data("analytic:v6_layers:8");
  ASSERT_TRUE(layers);
  EXPECT_EQ(layers->problem, reference::AnalyticProblem::v6_layers);
  EXPECT_EQ(layers->size, 8);
  for (const char* wrong : {"analytic:", "analytic:v2_ramp", "analytic:v2_ramp:", "analytic:ramp:8",
                            "analytic:v2_ramp:8x8x8", "analytic:v2_ramp:1", "analytic:v6_layers:7",
                            "analytic:v2_ramp:1000"}) {
    EXPECT_THROW((void)analytic_data(wrong), core::InputError) << wrong;
  }
}

}  // namespace
}  // namespace triptych::volume_suite
