// Tests the catalogue of stress cases, and its use by plans.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "measure/plan/plan.hpp"
#include "suites/particles/stress_cases.hpp"
#include "suites/particles/suite.hpp"

namespace triptych::particles_suite {
namespace {

std::vector<std::string> all_data() {
  std::vector<std::string> names;
  for (const StressCase& each : stress_cases()) {
    if (each.variants.empty()) names.push_back(fmt::format("stress:{}", each.name));
    for (const std::string_view variant : each.variants) {
      names.push_back(fmt::format("stress:{}:{}", each.name, variant));
    }
  }
  return names;
}

measure::Configuration defaults(const measure::Suite& suite) {
  measure::Configuration configuration;
  for (const measure::Factor& factor : suite.factors())
    configuration[factor.name] = factor.default_value;
  return configuration;
}

TEST(StressCases, NumbersAreConsecutiveAndNamesAreParsed) {
  int number = 33;
  for (const StressCase& each : stress_cases()) {
    EXPECT_EQ(each.number, number++);
    EXPECT_FALSE(each.summary.empty());
    EXPECT_FALSE(each.expected.empty());
  }
  EXPECT_EQ(number, 55);
  for (const std::string& name : all_data()) {
    const auto data = stress_data(name);
    ASSERT_TRUE(data) << name;
    EXPECT_EQ(name_of(*data), name);
  }
  EXPECT_FALSE(stress_data("generate:uniform:10"));
}

TEST(StressCases, UnknownCasesAreRejectedWithTheKnownOnes) {
  const auto message = [](std::string_view data) -> std::string {
    try {
      static_cast<void>(stress_data(data));
    } catch (const core::InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message("stress:fair").find("scale, far, giant"), std::string::npos);
  EXPECT_NE(message("stress:far").find("1e3, 1e4, 1e5, 2e5"), std::string::npos);
  EXPECT_NE(message("stress:far:1e9").find("1e3, 1e4, 1e5, 2e5"), std::string::npos);
  EXPECT_NE(message("stress:giant:huge").find("no variants"), std::string::npos);
}

// The plan contains all cases except the largest pile, which would take too long on every device.
TEST(StressCases, ThePlanContainsEveryCase) {
  const auto suite = make_suite({});
  const measure::Plan plan = measure::load_plan(
      "particles/stress", {}, [&](std::string_view) -> measure::Suite& { return *suite; });
  EXPECT_FALSE(plan.timed());
  std::set<std::string> planned;
  for (const measure::Configuration& each : plan.configurations) planned.insert(each.at("data"));
  planned.insert("stress:pile:10000000");
  const std::vector<std::string> all = all_data();
  EXPECT_EQ(planned, std::set<std::string>(all.begin(), all.end()));
}

TEST(StressSuite, OwnSelectsTheCameraAndViewportOfTheCase) {
  const auto suite = make_suite({});
  measure::Configuration configuration = defaults(*suite);
  configuration["data"] = "stress:widest";
  for (const char* factor : {"camera", "fov", "viewport"}) configuration[factor] = "own";
  const core::Image limit = suite->limit(configuration).image;
  EXPECT_EQ(limit.width, 16384);
  EXPECT_EQ(limit.height, 8);
  // A different field of view produces a different image.
  configuration["fov"] = "1";
  EXPECT_NE(suite->limit(configuration).image.ids, limit.ids);
}

TEST(StressSuite, OtherDataHaveNoCameraOfTheirOwn) {
  const auto suite = make_suite({});
  for (const std::string factor : {"camera", "fov", "viewport"}) {
    measure::Configuration configuration = defaults(*suite);
    configuration["data"] = "generate:uniform:10";
    configuration[factor] = "own";
    try {
      static_cast<void>(suite->limit(configuration));
      FAIL() << factor;
    } catch (const core::InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(factor)) << error.what();
    }
  }
}

TEST(StressSuite, TiedVariantsNameTheOneTheyAreTiedTo) {
  const auto suite = make_suite({});
  measure::Configuration configuration = defaults(*suite);
  const auto expected = [&](const char* data) {
    configuration["data"] = data;
    return suite->expectations(configuration);
  };
  EXPECT_TRUE(expected("stress:scale:unit").empty());
  EXPECT_TRUE(expected("generate:uniform:10").empty());
  const auto small = expected("stress:scale:small");
  ASSERT_EQ(small.size(), 1U);
  const auto& same_image = std::get<record::SameImage>(small[0].rule);
  EXPECT_EQ(same_image.changed.at("data"), "stress:scale:unit");
  EXPECT_EQ(same_image.depth_scale, 0x1.0p-20F);
  EXPECT_TRUE(same_image.bit_identical);
  ASSERT_EQ(expected("stress:order:shuffled").size(), 1U);
  ASSERT_EQ(expected("stress:no_sphere:with").size(), 1U);
  ASSERT_EQ(expected("stress:count:0").size(), 1U);
  EXPECT_TRUE(std::holds_alternative<record::UniformColour>(expected("stress:count:0")[0].rule));
}

}  // namespace
}  // namespace triptych::particles_suite
