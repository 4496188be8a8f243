// The shift by anchors and by the body.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/random.hpp"
#include "judge/timing/shift.hpp"
#include "tests/support/normal.hpp"
#include "timing_bench.hpp"

namespace triptych::judge {
namespace {

using test::normal;

// 48 configurations with 3 % of scatter and 10 anchors with 9 %, as a shared machine has them.
struct Device {
  std::size_t configurations = 48;
  double noise = 0.03;
  double anchor_noise = 0.09;
  double slower_by = 1;  // the first `planted`
  std::size_t planted = 0;
  double device_slower_by = 1;  // anchors too
  int runs = 8;
  int runs_without_anchors = 0;  // of the stored ones, the first
  double slower_in_them_by = 1;

  [[nodiscard]] std::vector<TimingCase> draw(std::uint64_t seed) const {
    const Bench body{.configurations = configurations,
                     .runs = runs,
                     .noise = noise,
                     .now_shift = std::log(device_slower_by),
                     .slower_by = slower_by,
                     .planted = planted};
    const Bench anchors{.configurations = 0,
                        .anchors = 10,
                        .runs = runs,
                        .noise = anchor_noise,
                        .now_shift = std::log(device_slower_by)};
    std::vector<TimingCase> cases = body.draw(seed);
    for (int run = 0; run < runs_without_anchors; ++run) {
      for (TimingCase& each : cases) {
        each.stored_ns.at(fmt::format("run{}", run)) *= slower_in_them_by;
      }
    }
    for (TimingCase& anchor : anchors.draw(seed + 1000)) {
      anchor.witness = true;
      for (int run = 0; run < runs_without_anchors; ++run) {
        anchor.stored_ns.erase(fmt::format("run{}", run));
      }
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

// Two of ten anchors are a factor of two apart from run to run: the median of all knows better.
TEST(TimingShift, WildAnchorsHideNoSlowerProgram) {
  const auto draw = [](std::uint64_t seed, double slower_by) {
    auto cases = Device{.anchor_noise = 0.02, .slower_by = slower_by, .planted = 48}.draw(seed);
    const auto wild = Device{.configurations = 0, .anchor_noise = 0.4}.draw(seed + 5000);
    std::copy_n(wild.begin(), 2, cases.end() - 2);
    return cases;
  };
  const auto slower = [&](double by) {
    int count = 0;
    for (int gate = 1; gate <= gates; ++gate) {
      count += judge_timings(draw(static_cast<std::uint64_t>(gate), by)).programs.at(0).slower;
    }
    return static_cast<double>(count) / gates;
  };
  EXPECT_GE(slower(1.1), 0.9);
  EXPECT_LE(slower(1), up_to_chance(TimingModel::false_program_alarms));
}

// In two of eight stored runs only the program met a slow minute, or only the anchors did: how far
// the two witnesses may be apart is what most runs say.
TEST(TimingShift, StoredMinutesOfOneWitnessHideNoSlowerProgram) {
  const auto slower = [&](bool of_anchors, double by) {
    int count = 0;
    for (int gate = 1; gate <= gates; ++gate) {
      auto cases = Device{.anchor_noise = 0.02, .slower_by = by, .planted = 48}.draw(
          static_cast<std::uint64_t>(gate));
      for (TimingCase& each : cases) {
        if (each.anchor != of_anchors) continue;
        each.stored_ns["run2"] *= 1.15;
        each.stored_ns["run5"] *= 1.25;
      }
      count += judge_timings(cases).programs.at(0).slower;
    }
    return static_cast<double>(count) / gates;
  };
  for (const bool of_anchors : {false, true}) {
    SCOPED_TRACE(of_anchors);
    EXPECT_GE(slower(of_anchors, 1.15), 0.9);
    EXPECT_LE(slower(of_anchors, 1), up_to_chance(TimingModel::false_program_alarms));
  }
}

// Five runs of one device hardly tell how far the witnesses are apart; of three they do.
TEST(TimingShift, DevicesLendEachOtherTheirScatter) {
  const auto draw = [](std::size_t devices) {
    std::vector<TimingCase> cases;
    for (std::size_t i = 0; i < devices; ++i) {
      for (TimingCase& each : Device{.anchor_noise = 0.01}.draw(i + 1)) {
        each.device = fmt::format("d{}", i);
        cases.push_back(std::move(each));
      }
    }
    return cases;
  };
  const ProgramJudgement alone = judge_timings(draw(1)).programs.at(0);
  const ProgramJudgement among = judge_timings(draw(3)).programs.at(0);
  EXPECT_DOUBLE_EQ(among.log_ratio, alone.log_ratio);
  EXPECT_GT(among.degrees, 2 * alone.degrees);
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

// Runs stored before anchors were measured beside them, on a device that was slower or faster then.
TEST(TimingShift, RunsWithoutAnchorsAreLevelledToo) {
  const DeviceScore best = score(Device{.slower_by = 1.25, .planted = 1, .runs = 11});
  for (const double by : {0.8, 1.25}) {
    SCOPED_TRACE(by);
    const Device same{.runs = 11, .runs_without_anchors = 6, .slower_in_them_by = by};
    EXPECT_LE(score(same).false_discoveries, q);
    Device slow = same;
    slow.slower_by = 1.25;
    slow.planted = 1;
    EXPECT_LE(best.found, up_to_chance(score(slow).found));
  }
}

// A changed program is no witness of the device: those runs say nothing then, the others do.
TEST(TimingShift, RunsWithoutAnchorsSayNothingBesideAChangedProgram) {
  for (const double by : {0.8, 1.25}) {
    SCOPED_TRACE(by);
    const Device device{.noise = 0.02,
                        .anchor_noise = 0.02,
                        .slower_by = 1.15,
                        .planted = 48,
                        .runs = 12,
                        .runs_without_anchors = 6,
                        .slower_in_them_by = by};
    const DeviceScore s = score(device);
    EXPECT_GE(s.program_slower, 0.99);
    EXPECT_GE(s.found, 0.9);
    EXPECT_EQ(judge_timings(device.draw(1)).cases[0].runs, 6U);
  }
}

// A configuration that lacks most of the runs with anchors is not told then, and not passed.
TEST(TimingShift, TooFewRunsWithAnchorsAreNotTold) {
  const Device device{.anchor_noise = 0.02,
                      .slower_by = 1.15,
                      .planted = 48,
                      .runs = 12,
                      .runs_without_anchors = 6};
  auto cases = device.draw(1);
  cases[0].stored_ns.erase("run11");
  cases[0].stored_ns.erase("run10");
  const TimingJudgement judged = judge_timings(cases).cases[0];
  EXPECT_EQ(judged.runs, 4U);
  EXPECT_FALSE(judged.slower || judged.faster);
  EXPECT_TRUE(judged.too_noisy(cases[0].tolerance));
}

}  // namespace
}  // namespace triptych::judge
