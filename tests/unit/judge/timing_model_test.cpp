#include "judge/timing_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/random.hpp"
#include "judge/timing_shift.hpp"

namespace triptych::judge {
namespace {

double normal(core::Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
  return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

// A gate's worth of synthetic timings. ln t = level of the configuration + what moved the whole run
// + noise of its own size per configuration.
struct Bench {
  std::size_t configurations = 60;
  std::size_t anchors = 0;
  int runs = 8;
  double noise = 0.01;   // standard deviation of ln t of a typical configuration
  double common = 0;     // of a whole run
  double now_shift = 0;  // of this run, device and all
  double slower_by = 1;  // factor on the planted configurations
  std::size_t planted = 0;
  double busier = 1;         // the noise of this run's rounds, in that of the stored runs
  bool knows_rounds = true;  // else it was of one round

  [[nodiscard]] std::vector<TimingCase> draw(std::uint64_t seed) const {
    core::Random random(seed);
    std::vector<double> moved;
    for (int run = 0; run < runs; ++run) moved.push_back(common * normal(random));
    const double moved_now = common * normal(random) + now_shift;
    std::vector<TimingCase> cases;
    for (std::size_t i = 0; i < configurations + anchors; ++i) {
      TimingCase timing;
      timing.device = "d";
      timing.anchor = i >= configurations;
      const double level = std::log(1e6) + 4 * random.uniform();
      const double own_noise = noise * std::exp(0.4 * normal(random));
      for (int run = 0; run < runs; ++run) {
        timing.stored_ns[fmt::format("run{}", run)] =
            std::exp(level + moved[static_cast<std::size_t>(run)] + own_noise * normal(random));
      }
      const double planted_shift = i < planted ? std::log(slower_by) : 0;
      std::vector<double> rounds;
      for (int round = 0; round < (busier > 1 ? 4 : 1); ++round) {
        rounds.push_back(
            std::exp(level + moved_now + planted_shift + busier * own_noise * normal(random)));
      }
      timing.median_ns = std::ranges::min(rounds);
      if (knows_rounds) timing.variance_of_rounds = variance_of_rounds(rounds);
      timing.tolerance = std::log(TimingModel::tolerated);
      cases.push_back(std::move(timing));
    }
    return cases;
  }
};

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

constexpr int gates = 400;
constexpr double q = TimingModel::share_of_false_alarms;

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
  slower.slower_by = 1.6;
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
  const double error = std::sqrt(0.00025 * 1.2);
  EXPECT_NEAR(judged.log_ratio, 0.1, 1e-12);
  EXPECT_NEAR(judged.standard_error, error, 1e-12);
  EXPECT_NEAR(judged.t, 0.08 / error, 1e-9);
  EXPECT_EQ(judged.degrees, 4);
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

// --- the shift by anchors and by the body

// 48 configurations with 3 % of scatter and 10 anchors with 9 %, as a shared machine has them.
struct Device {
  std::size_t configurations = 48;
  double noise = 0.03;
  double anchor_noise = 0.09;
  double slower_by = 1;  // the first `planted`
  std::size_t planted = 0;
  double device_slower_by = 1;  // anchors too

  [[nodiscard]] std::vector<TimingCase> draw(std::uint64_t seed) const {
    const Bench body{.configurations = configurations,
                     .noise = noise,
                     .now_shift = std::log(device_slower_by),
                     .slower_by = slower_by,
                     .planted = planted};
    const Bench anchors{.configurations = 0,
                        .anchors = 10,
                        .noise = anchor_noise,
                        .now_shift = std::log(device_slower_by)};
    std::vector<TimingCase> cases = body.draw(seed);
    for (TimingCase& anchor : anchors.draw(seed + 1000)) {
      anchor.witness = true;
      cases.push_back(std::move(anchor));
    }
    return cases;
  }
};

// Means over many gates of one device.
struct DeviceScore {
  double found = 0;              // of the planted configurations
  double false_discoveries = 0;  // share of all that is called slower
  double undecided = 0;          // of the others
  double program_slower = 0;     // gates that say so
  double program_unclear = 0;    // gates that cannot exclude a fifth
};

DeviceScore score(const Device& device) {
  DeviceScore sum;
  for (int gate = 0; gate < gates; ++gate) {
    const auto cases = device.draw(static_cast<std::uint64_t>(gate) + 1);
    const TimingJudgements judged = judge_timings(cases);
    std::size_t right = 0;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < device.configurations; ++i) {
      const TimingJudgement& each = judged.cases[i];
      if (each.slower) ++(i < device.planted ? right : wrong);
      if (i < device.planted) continue;
      const bool unclear = !each.slower && !each.faster && each.too_noisy(cases[i].tolerance);
      sum.undecided +=
          unclear ? 1.0 / static_cast<double>(device.configurations - device.planted) : 0;
    }
    const ProgramJudgement& program = judged.programs.at(0);
    if (device.planted > 0) {
      sum.found += static_cast<double>(right) / static_cast<double>(device.planted);
    }
    if (wrong > 0) {
      sum.false_discoveries += static_cast<double>(wrong) / static_cast<double>(wrong + right);
    }
    sum.program_slower += program.slower ? 1 : 0;
    sum.program_unclear += !program.slower && program.too_noisy(program.tolerance) ? 1 : 0;
  }
  for (double* each : {&sum.found, &sum.false_discoveries, &sum.undecided, &sum.program_slower,
                       &sum.program_unclear}) {
    *each /= gates;
  }
  return sum;
}

// A rate of `gates` trials may lie so far above its expectation by chance.
double up_to_chance(double rate) {
  return rate + 3 * std::sqrt(rate * (1 - rate) / gates);
}

// Against the same configurations beside anchors that know the shift exactly.
TEST(TimingShift, NoisyAnchorsHideNothing) {
  const double exact = 1e-4;
  const DeviceScore same = score(Device{});
  EXPECT_LE(same.false_discoveries, q);
  EXPECT_LE(same.undecided, up_to_chance(score(Device{.anchor_noise = exact}).undecided));
  EXPECT_LE(same.program_slower, up_to_chance(TimingModel::false_program_alarms));
  const DeviceScore slow = score(Device{.slower_by = 1.25, .planted = 1});
  const DeviceScore best = score(Device{.anchor_noise = exact, .slower_by = 1.25, .planted = 1});
  EXPECT_LE(best.found, up_to_chance(slow.found));
  EXPECT_LE(slow.false_discoveries, q);
}

// The device's own slowness is the body's to tell; the anchors do not contradict.
TEST(TimingShift, ASlowerDeviceIsNoSlowerProgram) {
  const DeviceScore s = score(Device{.device_slower_by = 1.25});
  const DeviceScore same = score(Device{});
  EXPECT_DOUBLE_EQ(s.false_discoveries, same.false_discoveries);
  EXPECT_DOUBLE_EQ(s.undecided, same.undecided);
  EXPECT_LE(s.program_slower, up_to_chance(TimingModel::false_program_alarms));
  const auto judged = judge_timings(Device{.device_slower_by = 1.25}.draw(1)).cases;
  EXPECT_NEAR(judged[0].shift, std::log(1.25), 0.03);  // the anchors alone know it to 4 %
}

// Still anchors: the program it is, and every configuration with it.
TEST(TimingShift, ASlowerProgramIsToldFromTheDevice) {
  const Device device{.anchor_noise = 0.02, .slower_by = 1.15, .planted = 48};
  const DeviceScore s = score(device);
  EXPECT_GE(s.program_slower, 0.99);
  EXPECT_GE(s.found, 0.9);
  const auto judged = judge_timings(device.draw(1));
  EXPECT_NEAR(judged.programs.at(0).log_ratio, std::log(1.15), 0.03);
  EXPECT_NEAR(judged.cases[0].shift, 0, 0.03);
}

// Anchors that scatter too much to tell: no configuration is slower than the others, but the
// program as a whole does not pass.
TEST(TimingShift, ASlowerProgramThatAnchorsCannotTellDoesNotPass) {
  const DeviceScore s = score(Device{.anchor_noise = 0.25, .slower_by = 1.15, .planted = 48});
  EXPECT_LE(s.found, 0.5);
  EXPECT_GE(s.program_slower + s.program_unclear, 0.9);
}

// The median of the body breaks where half of it is slower: its interval spans both halves, and
// the anchors decide between them.
TEST(TimingShift, HalfOfTheConfigurationsSlowerIsFound) {
  for (const std::size_t planted : {16U, 20U, 24U, 28U}) {
    SCOPED_TRACE(planted);
    const DeviceScore s = score(Device{.anchor_noise = 0.05, .slower_by = 1.3, .planted = planted});
    EXPECT_GE(s.found, 0.8);
    EXPECT_LE(s.false_discoveries, q);
  }
}

// Of three each is judged by the other two and the anchors.
TEST(TimingShift, ThreeConfigurationsAreEnough) {
  const DeviceScore same = score(Device{.configurations = 3});
  EXPECT_LE(same.false_discoveries, q);
  const DeviceScore slow =
      score(Device{.configurations = 3, .noise = 0.01, .slower_by = 1.3, .planted = 1});
  EXPECT_GE(slow.found, 0.9);
  EXPECT_LE(slow.false_discoveries, q);
}

TEST(TimingShift, TwoConfigurationsAreJudgedByTheAnchors) {
  const auto cases = Device{.configurations = 2, .anchor_noise = 0.01}.draw(1);
  EXPECT_TRUE(judge_timings(cases).programs.empty());
  EXPECT_GT(std::abs(judge_timings(cases).cases[0].shift), 0);
}

TEST(TimingShift, TheMedianOfManyNormalValuesHasItsVariance) {
  double sum = 0;
  core::Random random(3);
  for (int i = 0; i < gates; ++i) {
    std::vector<double> values(49);
    for (double& value : values) value = normal(random);
    std::ranges::sort(values);
    sum += variance_of_median(values);
  }
  // π/2n of normal values; the estimate is known to be large by less than a tenth at this n
  // (Price and Bonett 2001), and its mean over so many to 3 %.
  EXPECT_NEAR(sum / gates, std::numbers::pi / 2 / 49, 0.13 * std::numbers::pi / 2 / 49);
}

TEST(TimingShift, TheMedianOfTwoPartsIsAnywhereBetweenThem) {
  std::vector<double> values(48, 0.0);
  std::fill(values.begin() + 24, values.end(), 1.0);
  EXPECT_GT(std::sqrt(variance_of_median(values)), 0.15);
  std::fill(values.begin() + 24, values.begin() + 34, 0.0);
  EXPECT_EQ(variance_of_median(values), 0);
}

}  // namespace
}  // namespace triptych::judge
