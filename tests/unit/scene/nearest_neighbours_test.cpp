#include "scene/nearest_neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "core/random.hpp"

namespace triptych::scene {
namespace {

using Place = std::array<double, 3>;

TEST(NearestNeighbours, AgreeWithASearchOfAllPairs) {
  core::Random random(1);
  std::vector<Place> places(301);
  for (Place& place : places) {
    for (double& x : place) x = random.uniform() * random.uniform();
  }
  places[7] = {1e12, 0, 0};  // far away from all others
  std::vector<double> nearest;
  for (const Place& a : places) {
    double best = std::numeric_limits<double>::infinity();
    for (const Place& b : places) {
      if (a != b) best = std::min(best, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
    nearest.push_back(best);
  }
  std::ranges::sort(nearest);
  const auto median = median_nearest_distance(places);
  ASSERT_TRUE(median);
  EXPECT_NEAR(*median, nearest[150], 1e-12);
}

TEST(NearestNeighbours, IgnoreEqualAndInfinitePositions) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::vector<Place> places{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {3, 0, 0}, {inf, 0, 0}};
  EXPECT_EQ(median_nearest_distance(places), 3);
  EXPECT_EQ(median_nearest_distance({{1, 2, 3}, {1, 2, 3}}), std::nullopt);
  EXPECT_EQ(median_nearest_distance({}), std::nullopt);
}

// Squared distances of positions beyond single precision would overflow or underflow, and could not
// show which position is nearer.
TEST(NearestNeighbours, IgnorePositionsBeyondSinglePrecisionAndStayFast) {
  std::vector<Place> places;
  for (int i = 0; i < 1000; ++i) places.push_back({i * 0.5, 0, 0});
  for (int i = 0; i < 2000; ++i) places.push_back({1e200 * (i + 1), 0, 0});
  EXPECT_EQ(median_nearest_distance(places), 0.5);
  const auto seconds_of = [](double unit) {
    std::vector<Place> line;
    for (int i = 0; i < 30'000; ++i) line.push_back({unit * i, unit * (i % 173), unit * (i % 71)});
    // Measures CPU time, which does not depend on other running programs.
    const std::clock_t start = std::clock();
    static_cast<void>(median_nearest_distance(std::move(line)));
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  EXPECT_LT(seconds_of(1e-200), 10 * seconds_of(1) + 0.05);
  EXPECT_LT(seconds_of(1e200), 10 * seconds_of(1) + 0.05);
}

TEST(NearestNeighbours, UseASampleOfManyPoints) {
  std::vector<Place> places;
  for (int i = 0; i < 300'000; ++i) places.push_back({i * 0.5, 0, 0});
  EXPECT_EQ(median_nearest_distance(std::move(places)), 0.5);
}

}  // namespace
}  // namespace triptych::scene
