#include "judge/gate/stored_scatter.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace triptych::judge {
namespace {

// The i-th run of a day; anchors begin a minute before their plan.
std::string id_of(std::size_t i, bool of_anchors) {
  return fmt::format("20261122T{:02}{}00Z-{}", i, of_anchors ? "00" : "01", of_anchors ? "a" : "p");
}

// Five configurations that all moved by these ln t from run to run.
StoredTimes stored(const std::vector<double>& moved, bool of_anchors) {
  StoredTimes times;
  for (int configuration = 0; configuration < 5; ++configuration) {
    auto& runs = times[fmt::format("n={}", configuration)];
    for (std::size_t i = 0; i < moved.size(); ++i) {
      runs.push_back({.run = id_of(i, of_anchors),
                      .median_ns = 1e6 * (configuration + 1) * std::exp(moved[i]),
                      .clock = "wall",
                      .kernel_hash = {}});
    }
  }
  return times;
}

TEST(ScatterBesideAnchors, IsOfWhatOnlyOneOfTheTwoMet) {
  // The device was slower in the second run, and the program alone in the fourth.
  const StoredTimes anchors = stored({0, 0.3, 0.01, 0, 0.02, 0}, true);
  const StoredTimes program = stored({0, 0.3, 0, 0.2, 0, 0.01}, false);
  const std::vector<double> distances{0, 0, -0.01, 0.2, -0.02, 0.01};
  const KnownVariance all = scatter_beside_anchors(program, anchors, {});
  EXPECT_NEAR(all.variance, robust_variance(distances), 1e-12);
  EXPECT_DOUBLE_EQ(all.degrees, robust_degrees(6));
  const KnownVariance others = scatter_beside_anchors(program, anchors, id_of(3, false));
  EXPECT_DOUBLE_EQ(others.degrees, robust_degrees(5));
}

TEST(ScatterBesideAnchors, OfFewRunsIsNotKnown) {
  EXPECT_EQ(scatter_beside_anchors(stored({0, 0.1}, false), stored({0, 0}, true), {}).degrees, 0);
  EXPECT_EQ(scatter_beside_anchors(stored({0, 0, 0}, false), {}, {}).degrees, 0);
  // A clock's steps make runs identical.
  const KnownVariance still =
      scatter_beside_anchors(stored({0, 0, 0}, false), stored({0, 0, 0}, true), {});
  EXPECT_GT(still.variance, 0);
  EXPECT_GT(still.degrees, 0);
}

}  // namespace
}  // namespace triptych::judge
