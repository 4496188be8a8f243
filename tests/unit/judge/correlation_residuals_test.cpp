// Tests how changes of residuals (logarithms of the ratio of two devices' costs) are attributed to
// levels and configurations.

#include <gmock/gmock.h>

#include <cmath>

#include "judge/correlation/residuals.hpp"

namespace triptych::judge {
namespace {

using Scope = Movement::Scope;

// Returns all combinations of the factors a, b and c, which have 2, 3 and 4 levels.
std::vector<Factors> grid() {
  std::vector<Factors> all;
  for (int i = 0; i < 24; ++i) {
    all.push_back({{"a", std::to_string(i % 2)},
                   {"b", std::to_string(i / 2 % 3)},
                   {"c", std::to_string(i / 6)}});
  }
  return all;
}

std::vector<double> moved(const std::function<double(const Factors&)>& by) {
  std::vector<double> result;
  for (const Factors& each : grid()) result.push_back(by(each));
  return result;
}

TEST(Explain, NothingMoved) {
  EXPECT_TRUE(explain(std::vector<double>(24, 0.0), grid()).empty());
}

TEST(Explain, ALevelWhoseConfigurationsMovedDifferently) {
  int i = 0;
  const auto by =
      moved([&](const Factors& f) { return f.at("b") == "1" ? 0.01 + 0.001 * ++i : 0; });
  const auto found = explain(by, grid());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].scope, Scope::level);
  EXPECT_EQ(found[0].level, "b=1");
  EXPECT_NEAR(found[0].least, 0.011, 1e-12);
  EXPECT_NEAR(found[0].most, 0.018, 1e-12);
}

TEST(Explain, TwoLevels) {
  const auto by = moved([](const Factors& f) {
    return f.at("c") == "3" ? 0.05 : f.at("b") == "0" ? 0.01 : 0;
  });
  const auto found = explain(by, grid());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].level, "c=3");
  EXPECT_EQ(found[1].level, "b=0");
}

TEST(Explain, OutliersInsideAndOutsideOfALevel) {
  const auto factors = grid();
  auto by = moved([](const Factors& f) { return f.at("c") == "3" ? 0.01 : 0; });
  by[20] = 0.2;
  by[0] = -0.02;
  const auto found = explain(by, factors);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].level, "c=3");
  EXPECT_EQ(found[1].members, std::vector<std::size_t>{20});
  EXPECT_EQ(found[2].members, std::vector<std::size_t>{0});
}

TEST(Explain, OneConfigurationIsNotALevel) {
  std::vector<double> by(24, 0.0);
  by[7] = 0.5;
  const auto found = explain(by, grid());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].scope, Scope::configuration);
}

TEST(Explain, LevelsWithTheSameConfigurationsCountOnce) {
  auto factors = grid();
  for (Factors& each : factors) each["d"] = each.at("b");
  const auto by = moved([](const Factors& f) { return f.at("b") == "2" ? 0.01 : 0; });
  const auto found = explain(by, factors);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].level, "b=2 (= d=2)");
}

TEST(Repeatability, BoundsApplyToEachPart) {
  const Repeatability bound = repeatability("opencl:pocl", "raycast", {1e7, 0});
  EXPECT_EQ(significant_change({0, 3.6e-3}, bound), 0);
  EXPECT_NEAR(significant_change({0, 3.8e-3}, bound), 3.8e-3, 1e-5);
  // The first number is the change of the device code, and the second is the change of the driver.
  // A change within the driver's jitter does not count, so only the change of the device code
  // remains.
  EXPECT_NEAR(significant_change({1e-4, -2e-3}, bound), 1e-4, 1e-6);
  EXPECT_EQ(significant_change({0.9e-5, 0}, repeatability("vulkan:lavapipe", "tiles", {1e7, 0})),
            0);
  EXPECT_NE(significant_change({0.9e-5, 0}, repeatability("vulkan:lavapipe", "raycast", {1e7, 0})),
            0);
  EXPECT_EQ(significant_change({0, 6.9e-4}, repeatability("vulkan:lavapipe", "raycast", {1e7, 0})),
            0);
  EXPECT_NE(significant_change({0, 7.1e-4}, repeatability("vulkan:lavapipe", "raycast", {1e7, 0})),
            0);
}

TEST(Repeatability, TheBoundOfAResidualIsTheSumOfBoth) {
  const Repeatability mesa = repeatability("vulkan:lavapipe", "raycast", {1e7, 0});
  EXPECT_FALSE(residual_moved({0, -4e-4}, mesa, {0, 4e-4}, mesa));
  EXPECT_TRUE(residual_moved({0, -8e-4}, mesa, {0, 8e-4}, mesa));
  EXPECT_FALSE(residual_moved({0.01, 0}, mesa, {0.01, 0}, mesa));
}

}  // namespace
}  // namespace triptych::judge
