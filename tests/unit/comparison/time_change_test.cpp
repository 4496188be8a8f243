#include "comparison/time_change.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace triptych::comparison {
namespace {

constexpr double undisturbed = 0.005;  // the smallest judge::log_spread

TEST(TimeChange, WithoutPairsThereIsNone) {
  EXPECT_FALSE(time_change({}));
}

// On an undisturbed machine, a change of 1.4 % can be distinguished from noise.
TEST(TimeChange, TheSpreadBetweenProcessesIsNoise) {
  const double half_width = 1.96 * std::sqrt(2.0) * undisturbed;
  for (const auto& [ratio, noise] :
       {std::pair(1.01, true), {1.02, false}, {0.99, true}, {0.98, false}}) {
    const std::vector<TimePair> pairs(20, {100, 100 * ratio, undisturbed, undisturbed});
    const auto change = time_change(pairs);
    ASSERT_TRUE(change);
    EXPECT_NEAR(change->ratio, ratio, 1e-9);
    EXPECT_NEAR(change->half_width, half_width, 1e-9);
    EXPECT_EQ(change->is_noise(), noise) << ratio;
  }
}

TEST(TimeChange, ScatteringFramesAreNoise) {
  const std::vector<TimePair> pairs(20, {100, 120, 0.1, 0.1});
  EXPECT_TRUE(time_change(pairs)->is_noise());
}

// Two runs of the same plan on a loaded machine: the frames of each configuration agree, but the
// ratios of the configurations are between 0.55 and 2.42.
TEST(TimeChange, ScatteringConfigurationsAreNoise) {
  std::vector<TimePair> pairs;
  for (const double ratio : {0.55, 0.6, 0.62, 0.65, 0.7, 0.7, 0.72, 0.8, 1.1, 2.42}) {
    pairs.push_back({100, 100 * ratio, undisturbed, undisturbed});
  }
  const auto change = time_change(pairs);
  EXPECT_LT(change->ratio, 0.9);
  EXPECT_TRUE(change->is_noise());
}

}  // namespace
}  // namespace triptych::comparison
