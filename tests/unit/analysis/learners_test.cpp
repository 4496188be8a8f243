#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/random.hpp"
#include "analysis/learners.hpp"

namespace triptych::analysis {
namespace {

struct Sample {
  Features features;
  std::vector<double> targets;
};

template <typename Function>
Sample sample(std::size_t count, std::uint64_t seed, Function function) {
  core::Random random(seed);
  Sample result;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = random.uniform(0, 1);
    const double b = random.uniform(0, 1);
    result.features.push_back({a, b});
    result.targets.push_back(function(a, b));
  }
  return result;
}

template <typename Model>
double score(const Model& model, const Sample& held_out) {
  std::vector<double> predicted;
  for (const auto& row : held_out.features) predicted.push_back(model.predict(row));
  return *r_squared(held_out.targets, predicted);
}

TEST(Learners, LineFindsItsCoefficients) {
  const Sample line = sample(20, 1, [](double a, double b) { return 3 + 2 * a - 1e6 * b; });
  const LinearModel model(line.features, line.targets);
  EXPECT_NEAR(model.predict(std::vector<double>{0, 0}), 3, 1e-6);
  EXPECT_NEAR(model.predict(std::vector<double>{1, 0}), 5, 1e-6);
  EXPECT_NEAR(model.predict(std::vector<double>{0, 1}), 3 - 1e6, 1e-4);
}

TEST(Learners, DependentColumnsStillPredict) {
  Sample line = sample(20, 2, [](double a, double) { return 1 + 4 * a; });
  for (auto& row : line.features) row[1] = 2 * row[0];
  const LinearModel model(line.features, line.targets);
  EXPECT_NEAR(model.predict(std::vector<double>{0.5, 1}), 3, 1e-9);
}

TEST(Learners, ForestBeatsTheLineWhereNothingIsLinear) {
  const auto wavy = [](double a, double b) { return std::sin(12 * a) + (b > 0.5 ? 2 * a : -a); };
  const Sample trained = sample(800, 3, wavy);
  const Sample held_out = sample(200, 4, wavy);
  const LinearModel line(trained.features, trained.targets);
  const Forest forest(trained.features, {false, false}, trained.targets);
  EXPECT_GT(score(forest, held_out), 0.9);
  EXPECT_LT(score(line, held_out), 0.7);
}

TEST(Learners, LineBeatsTheForestWhereAllIsLinear) {
  const auto straight = [](double a, double b) { return 10 * a + b; };
  const Sample trained = sample(60, 3, straight);
  const Sample held_out = sample(200, 4, straight);
  const double line = score(LinearModel(trained.features, trained.targets), held_out);
  EXPECT_NEAR(line, 1, 1e-9);
  EXPECT_LT(score(Forest(trained.features, {false, false}, trained.targets), held_out), line);
}

TEST(Learners, CategoriesHaveNoOrder) {
  Features features;
  std::vector<double> targets;
  for (int i = 0; i < 240; ++i) {
    features.push_back({static_cast<double>(i % 8)});
    targets.push_back(i % 2 == 0 ? 1 : 5);  // even against odd: no threshold parts them
  }
  const Forest forest(features, {true}, targets, {.trees = 50, .depth = 1, .least_samples = 2});
  EXPECT_NEAR(forest.predict(std::vector<double>{2}), 1, 0.1);
  EXPECT_NEAR(forest.predict(std::vector<double>{3}), 5, 0.1);
}

TEST(Learners, SameInputSameForest) {
  const Sample trained = sample(100, 9, [](double a, double b) { return a * b; });
  const Forest one(trained.features, {false, false}, trained.targets);
  const Forest other(trained.features, {false, false}, trained.targets);
  const std::vector<double> place{0.3, 0.6};
  EXPECT_EQ(one.predict(place), other.predict(place));
}

TEST(Learners, RSquaredByHand) {
  const std::vector<double> values{1, 2, 3, 4};
  EXPECT_NEAR(*r_squared(values, values), 1, 1e-15);
  EXPECT_NEAR(*r_squared(values, std::vector<double>{2.5, 2.5, 2.5, 2.5}), 0, 1e-15);
  EXPECT_NEAR(*r_squared(values, std::vector<double>{1, 2, 3, 6}), 1 - 4.0 / 5, 1e-15);
  EXPECT_FALSE(r_squared(std::vector<double>{1, 1}, std::vector<double>{1, 2}));
}

TEST(Learners, NoRowsAreRefused) {
  EXPECT_THROW(LinearModel({}, {}), core::InputError);
}

}  // namespace
}  // namespace triptych::analysis
