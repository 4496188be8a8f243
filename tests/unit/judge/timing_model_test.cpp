#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "judge/statistics/statistics.hpp"
#include "judge/timing/model.hpp"
#include "timing_bench.hpp"

namespace triptych::judge {
namespace {

struct Score {
  double gates_alarmed = 0;  // share of gates with any slower verdict on an unplanted configuration
  double false_discoveries = 0;  // mean share of such among all slower verdicts
  double found = 0;              // share of the planted configurations found
};

Score score(const Bench& bench, int gates) {
  Score result;
  for (int gate = 0; gate < gates; ++gate) {
    const auto judged = judge_timings(bench.draw(static_cast<std::uint64_t>(gate) + 1)).cases;
    std::size_t right = 0;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < judged.size(); ++i) {
      if (judged[i].slower) ++(i < bench.planted ? right : wrong);
    }
    result.gates_alarmed += wrong > 0 ? 1 : 0;
    if (wrong > 0) {
      result.false_discoveries += static_cast<double>(wrong) / static_cast<double>(wrong + right);
    }
    if (bench.planted > 0) {
      result.found += static_cast<double>(right) / static_cast<double>(bench.planted);
    }
  }
  result.gates_alarmed /= gates;
  result.false_discoveries /= gates;
  result.found /= gates;
  return result;
}

TEST(TimingModel, NothingChangedRaisesNoMoreAlarmsThanStated) {
  const Score s = score({}, gates);
  RecordProperty("gates_alarmed", fmt::format("{:.4f}", s.gates_alarmed));
  EXPECT_LE(s.gates_alarmed, q);
}

TEST(TimingModel, NoisyRunsRaiseNoMoreAlarmsThanStated) {
  const Score s = score({.noise = 0.05}, gates);
  RecordProperty("gates_alarmed", fmt::format("{:.4f}", s.gates_alarmed));
  EXPECT_LE(s.gates_alarmed, q);
}

// Without anchors a slow run moves every configuration at once; what the stored runs say of that
// holds.
TEST(TimingModel, RunsThatMoveAsAWholeRaiseNoMoreAlarmsThanStated) {
  const Score s = score({.common = 0.03}, gates);
  RecordProperty("gates_alarmed", fmt::format("{:.4f}", s.gates_alarmed));
  EXPECT_LE(s.gates_alarmed, q);
}

TEST(TimingModel, ASlowerMachineIsToldByItsAnchors) {
  const Bench bench{.anchors = 6, .common = 0.03, .now_shift = std::log(1.3)};
  const Score s = score(bench, gates);
  EXPECT_LE(s.gates_alarmed, q);
  const auto judged = judge_timings(bench.draw(1)).cases;
  EXPECT_NEAR(judged[0].shift, std::log(1.3), 0.1);
  EXPECT_EQ(judged[0].anchors, 6U);
}

// Stored on a quiet day, judged on a busy one.
TEST(TimingModel, ABusyMachineIsToldByItsRounds) {
  const Bench busy{.anchors = 8, .busier = 10};
  const Score s = score(busy, gates);
  RecordProperty("gates_alarmed", fmt::format("{:.4f}", s.gates_alarmed));
  EXPECT_LE(s.gates_alarmed, q);
  Bench blind = busy;
  blind.knows_rounds = false;
  EXPECT_GT(score(blind, gates).gates_alarmed, 0.5);
  // What is slower beyond that noise is found.
  Bench slower = busy;
  slower.slower_by = 1.7;
  slower.planted = 3;
  EXPECT_GT(score(slower, gates).found, 0.9);
}

// One round as quick as ever excludes a slowdown, whatever the others were.
TEST(TimingModel, BusyRoundsOnlyWeakenSlower) {
  std::vector<TimingCase> calm = Bench{.anchors = 8, .noise = 0.03}.draw(7);
  std::vector<TimingCase> busy = calm;
  for (TimingCase& timing : busy) timing.variance_of_rounds = 0.09;
  const auto with = judge_timings(busy).cases;
  const auto without = judge_timings(calm).cases;
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i].half_width, without[i].half_width);
    EXPECT_EQ(with[i].p_faster, without[i].p_faster);
    EXPECT_EQ(with[i].too_noisy(busy[i].tolerance), without[i].too_noisy(calm[i].tolerance));
    EXPECT_LT(std::abs(with[i].t), std::abs(without[i].t));
  }
}

// ½(ln m₁ − ln m₂)² by hand; the middle one of three belongs to the first half.
TEST(TimingModel, VarianceOfRoundsIsOfTheTwoHalves) {
  EXPECT_FALSE(variance_of_rounds(std::vector<double>{}));
  EXPECT_FALSE(variance_of_rounds(std::vector<double>{7}));
  EXPECT_FALSE(variance_of_rounds(std::vector<double>{7, 0}));
  const double difference = std::log(1.1);
  const double expected = 0.5 * difference * difference;
  EXPECT_NEAR(*variance_of_rounds(std::vector<double>{300, 110, 100}), expected, 1e-15);
  EXPECT_NEAR(*variance_of_rounds(std::vector<double>{100, 300, 120, 110}), expected, 1e-15);
  EXPECT_EQ(*variance_of_rounds(std::vector<double>{100, 200, 200, 100}), 0);
}

// A lone anchor's own scatter must not become everybody's false alarm.
TEST(TimingModel, OneAnchorRaisesNoMoreAlarmsThanStated) {
  const Score s = score({.anchors = 1, .noise = 0.03}, gates);
  RecordProperty("gates_alarmed", fmt::format("{:.4f}", s.gates_alarmed));
  EXPECT_LE(s.gates_alarmed, q);
}

// At the edge of what is tolerated every rejection is false and nothing is left of the tolerance's
// reserve: the share of gates alarmed is q itself, up to three standard errors of this count.
TEST(TimingModel, TheEdgeOfToleranceAlarmsAsOftenAsStated) {
  const Score s = score({.noise = 0.02, .now_shift = std::log(TimingModel::tolerated)}, gates);
  RecordProperty("gates_alarmed", fmt::format("{:.4f}", s.gates_alarmed));
  EXPECT_LE(s.gates_alarmed, q + 3 * std::sqrt(q * (1 - q) / gates));
}

TEST(TimingModel, FalseDiscoveriesStayBelowQBesideRealOnes) {
  const Score s = score({.noise = 0.03, .slower_by = 1.25, .planted = 10}, gates);
  RecordProperty("false_discoveries", fmt::format("{:.4f}", s.false_discoveries));
  EXPECT_LE(s.false_discoveries, q);
  EXPECT_GE(s.found, 0.9);
}

TEST(TimingModel, FindsAFifthSlowerInOneConfiguration) {
  EXPECT_GE(score({.slower_by = 1.2, .planted = 1}, gates).found, 0.99);
  EXPECT_GE(score({.anchors = 6, .common = 0.03, .slower_by = 1.2, .planted = 1}, gates).found,
            0.99);
}

TEST(TimingModel, FindsAFifthSlowerEverywhere) {
  EXPECT_GE(score({.slower_by = 1.2, .planted = 60}, gates).found, 0.99);
}

TEST(TimingModel, FasterIsFoundToo) {
  const auto judged = judge_timings(Bench{.slower_by = 0.8, .planted = 1}.draw(3)).cases;
  EXPECT_TRUE(judged[0].faster);
  EXPECT_FALSE(judged[0].slower);
}

TEST(TimingModel, DevicesDoNotLendOneAnotherTheirNoise) {
  auto cases = Bench{.slower_by = 1.1, .planted = 1}.draw(5);
  auto noisy = Bench{.noise = 0.2}.draw(6);
  for (TimingCase& timing : noisy) timing.device = "other";
  const double alone = judge_timings(cases).cases[0].standard_error;
  cases.insert(cases.end(), noisy.begin(), noisy.end());
  EXPECT_DOUBLE_EQ(judge_timings(cases).cases[0].standard_error, alone);
}

// One configuration: the prior teaches nothing, and this is a plain t test of one new value.
TEST(TimingModel, OneCaseIsAPlainTTest) {
  TimingCase timing{.device = "d", .median_ns = std::exp(1.1), .tolerance = 0.02};
  const std::array stored{0.98, 0.99, 1.0, 1.01, 1.02};
  for (std::size_t i = 0; i < stored.size(); ++i) {
    timing.stored_ns[fmt::format("{}", i)] = std::exp(stored[i]);
  }
  const auto judged = judge_timings(std::span(&timing, 1)).cases.front();
  const double error = std::sqrt(robust_variance(stored) * (1 + std::numbers::pi / 2 / 5));
  EXPECT_NEAR(judged.log_ratio, 0.1, 1e-12);
  EXPECT_NEAR(judged.standard_error, error, 1e-12);
  EXPECT_NEAR(judged.t, 0.08 / error, 1e-9);
  EXPECT_EQ(judged.degrees, robust_degrees(5));
  EXPECT_TRUE(judged.slower);
}

TEST(TimingModel, IdenticalStoredTimesAreNoTrouble) {
  TimingCase timing{.device = "d", .median_ns = 100, .tolerance = std::log(1.02)};
  for (int i = 0; i < 6; ++i) timing.stored_ns[fmt::format("{}", i)] = 100;
  EXPECT_FALSE(judge_timings(std::span(&timing, 1)).cases.front().slower);
  timing.median_ns = 110;
  EXPECT_TRUE(judge_timings(std::span(&timing, 1)).cases.front().slower);
}

TEST(TimingModel, ScatterThatHidesAFifthIsTooNoisy) {
  const auto quiet = judge_timings(Bench{.noise = 0.03}.draw(9)).cases;
  const auto noisy = judge_timings(Bench{.noise = 0.5}.draw(9)).cases;
  EXPECT_FALSE(quiet[0].too_noisy(std::log(TimingModel::tolerated)));
  EXPECT_TRUE(noisy[0].too_noisy(std::log(TimingModel::tolerated)));
}

}  // namespace
}  // namespace triptych::judge
