// What the gate says of times, from records to verdict.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/file.hpp"
#include "fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::HasSubstr;
using testing::Not;

class TimingGateTest : public JudgeTest {
 protected:
  static Tweak times(double factor, const std::string& configuration = {}) {
    return [=](record::Record& record, core::Image&) {
      if (!configuration.empty() && record.configuration != configuration) return;
      for (double& ns : record.wall_ns) ns *= factor;
    };
  }

  // Its device times are a fifth of the wall's, so that mixing the two would show.
  static Tweak by_the_device(const Tweak& times) {
    return [=](record::Record& record, core::Image& image) {
      times(record, image);
      record.device_ns = record.wall_ns;
      for (double& ns : record.device_ns) ns /= 5;
      record.device_clock_trusted = true;
    };
  }

  // Eight runs, each with its anchors, of which every second is of a slower day.
  void accept_history_with_anchors(double slow_day = 1) {
    for (int i = 1; i <= 8; ++i) {
      const double day = i % 2 == 0 ? slow_day : 1.0;
      add_anchors(fmt::format("r{}-anchors", i), day);
      accept_anchors(fmt::format("r{}-anchors", i));
      add_run(fmt::format("r{}-run", i), times(day));
      (void)accept_run(fmt::format("r{}-run", i));
    }
  }
};

TEST_F(TimingGateTest, NoiseAlonePasses) {
  accept_history();
  add_run("b");
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::pass, Check::timing).size(), 12U);
}

TEST_F(TimingGateTest, AFifthSlowerIsARegression) {
  accept_history();
  add_run("b", times(1.2, bricks_));
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::regression);
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 3U) << text(result);
  EXPECT_EQ(slower[0].check, Check::timing);
  EXPECT_EQ(slower[0].configuration, bricks_);
  EXPECT_NEAR(slower[0].numbers.at("ratio"), 1.2, 0.02);
  EXPECT_THAT(slower[0].message, HasSubstr("8 stored runs"));
  EXPECT_THAT(slower[0].message, HasSubstr("work (samples) +0.0 %, time per unit of work +"));
}

TEST_F(TimingGateTest, MoreWorkIsToldFromSlowerWork) {
  accept_history();
  add_run("b", [&](record::Record& record, core::Image&) {
    if (record.configuration != bricks_) return;
    for (double& ns : record.wall_ns) ns *= 1.2;
    record.counters["samples"] = record.counters.at("samples") * 6 / 5;
  });
  const auto slower = with(gate("b"), Verdict::regression, Check::timing);
  ASSERT_EQ(slower.size(), 3U);
  EXPECT_THAT(slower[0].message, HasSubstr("work (samples) +20.0 %, time per unit of work "));
  EXPECT_NEAR(slower[0].numbers.at("work_ratio"), 1.2, 1e-3);
}

// Each run 1 % slower than the one before it: the gate against the mean finds the last runs, the
// drift finds when it began.
TEST_F(TimingGateTest, DriftOverAcceptedRunsIsTold) {
  for (int i = 0; i < 16; ++i) {
    const std::string run = fmt::format("r{:02}", i);
    add_run(run, times(std::pow(1.004, i), bricks_));
    (void)accept_run(run);
  }
  add_run("s", times(std::pow(1.004, 16), bricks_));
  const GateResult result = gate("s");
  const auto advice = with(result, Verdict::advisory, Check::timing);
  ASSERT_EQ(advice.size(), 3U) << text(result);
  for (const Finding& each : advice) {
    EXPECT_EQ(each.configuration, bricks_);
    EXPECT_THAT(each.message, HasSubstr("drift: +"));
  }
}

TEST_F(TimingGateTest, AFifthFasterIsListedAndPasses) {
  accept_history();
  add_run("b", times(0.8, bricks_));
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::improved, Check::timing).size(), 3U);
  EXPECT_THAT(result.headline(), HasSubstr("3 improved"));
}

TEST_F(TimingGateTest, FourStoredRunsOnlyAdvise) {
  for (const char* run : {"1", "2", "3", "4"}) {
    add_run(run);
    (void)accept_run(run);
  }
  add_run("b", times(1.5));
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory, Check::timing);
  ASSERT_EQ(advice.size(), 12U);
  EXPECT_NEAR(advice[0].numbers.at("ratio"), 1.5, 0.05);
  EXPECT_THAT(advice[0].message, HasSubstr("4 stored runs"));
}

TEST_F(TimingGateTest, AnAcceptedRunIsNoWitnessForItself) {
  for (const char* run : {"1", "2", "3", "4", "5"}) {
    add_run(run);
    (void)accept_run(run);
  }
  EXPECT_EQ(with(gate("5"), Verdict::advisory, Check::timing).size(), 12U);
}

TEST_F(TimingGateTest, AnotherClockCannotBeCompared) {
  accept_history();
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device != "vulkan:lavapipe") return;
    record.device_ns = std::exchange(record.wall_ns, {});
    record.device_clock_trusted = true;
  });
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  const auto undecided = with(result, Verdict::cannot_judge, Check::timing);
  ASSERT_EQ(undecided.size(), 4U) << text(result);
  EXPECT_THAT(undecided[0].message,
              HasSubstr("timed by the device clock, stored by the wall clock"));
}

TEST_F(TimingGateTest, ADeviceWhoseClockIsDoubtedTodayIsJudgedByTheWall) {
  accept_history(by_the_device(times(1)));
  add_run("same", times(1));
  EXPECT_EQ(with(gate("same"), Verdict::pass, Check::timing).size(), 12U) << text(gate("same"));
  add_run("slower", times(1.2, bricks_));
  EXPECT_EQ(with(gate("slower"), Verdict::regression, Check::timing).size(), 3U);
}

TEST_F(TimingGateTest, FewRunsOfAnotherClockOnlyAdvise) {
  add_run("1", [](record::Record& record, core::Image&) {
    record.device_ns = std::exchange(record.wall_ns, {});
    record.device_clock_trusted = true;
  });
  (void)accept_run("1");
  add_run("b");
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory, Check::timing);
  ASSERT_EQ(advice.size(), 12U);
  EXPECT_THAT(advice[0].message, HasSubstr("1 more are of another clock"));
}

TEST_F(TimingGateTest, NewDeviceCodeIsJudgedAndNamed) {
  accept_history();
  add_run("b", [](record::Record& record, core::Image& image) {
    times(1.2)(record, image);
    record.kernel_hash = "new";
  });
  const auto slower = with(gate("b"), Verdict::regression, Check::timing);
  ASSERT_EQ(slower.size(), 12U);
  EXPECT_THAT(slower[0].message, HasSubstr("the device code changed"));
}

TEST_F(TimingGateTest, NoTimeIsNoPass) {
  accept_history();
  add_run("b", [](record::Record& record, core::Image&) { record.wall_ns.clear(); });
  EXPECT_EQ(gate("b").exit_code(), ExitCode::cannot_judge);
}

TEST_F(TimingGateTest, ASlowerMachineIsNoSlowerProgram) {
  with_anchors_ = true;
  accept_history();
  add_run("b", times(1.3));
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory, Check::timing);
  ASSERT_EQ(advice.size(), 3U);  // one per device
  EXPECT_THAT(advice[0].message, HasSubstr("the device itself is +3"));
  add_run("c", [](record::Record& record, core::Image& image) {
    times(1.3)(record, image);
    times(1.2, plain_)(record, image);
  });
  EXPECT_EQ(with(gate("c"), Verdict::regression, Check::timing).size(), 3U);
}

// Anchors of their own plan, measured before each run, as the gate's script does.
TEST_F(TimingGateTest, AMachineThatItsOwnAnchorsShowSlowerIsNoSlowerProgram) {
  accept_history_with_anchors(1.15);
  add_anchors("s-anchors", 1.3);
  add_run("s-run", [](record::Record& record, core::Image& image) {
    times(1.3)(record, image);
    times(1.1, plain_)(record, image);
  });
  const GateResult result = gate("s-run");
  const auto slower = with(result, Verdict::regression, Check::timing);
  ASSERT_EQ(slower.size(), 3U) << text(result);
  for (const Finding& each : slower) EXPECT_EQ(each.configuration, plain_);
  EXPECT_NEAR(slower[0].numbers.at("ratio"), 1.1, 0.02);
  // Three configurations and the program as a whole on each device.
  EXPECT_EQ(with(result, Verdict::pass, Check::timing).size(), 9U + 3U);
  const auto advice = with(result, Verdict::advisory, Check::timing);
  ASSERT_EQ(advice.size(), 3U) << text(result);
  EXPECT_THAT(advice[0].message, HasSubstr("by 8 anchors"));
}

TEST_F(TimingGateTest, ASlowerProgramBesideStillAnchorsIsToldAsOne) {
  accept_history_with_anchors();
  add_anchors("s-anchors", 1);
  add_run("s-run", times(1.3));
  const GateResult result = gate("s-run");
  const auto slower = with(result, Verdict::regression, Check::timing);
  ASSERT_EQ(slower.size(), 12U + 3U) << text(result);
  const auto whole = std::ranges::find(slower, "program", &Finding::subject);
  ASSERT_NE(whole, slower.end());
  EXPECT_TRUE(whole->configuration.empty());
  EXPECT_THAT(whole->message, HasSubstr("the program as a whole is +"));
  EXPECT_NEAR(whole->numbers.at("ratio"), 1.3, 0.03);
}

// Of two launches the quieter one counts, of each thing for itself.
TEST_F(TimingGateTest, ASecondLaunchConfirmsOnlyWhatItShowsToo) {
  accept_history();
  add_run("b", [](record::Record& record, core::Image& image) {
    times(1.2, bricks_)(record, image);
    times(1.2, plain_)(record, image);
  });
  add_run("c", times(1.2, plain_));
  const GateResult alone = gate("b");
  ASSERT_EQ(with(alone, Verdict::regression).size(), 6U);
  EXPECT_EQ(alone.in_doubt.size(), 3U);
  EXPECT_THAT(alone.headline(), HasSubstr("; in doubt until --confirm: "));
  const GateResult result = gate("b", "c");
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 3U) << text(result);
  for (const Finding& each : slower) EXPECT_EQ(each.configuration, plain_);
  EXPECT_EQ(result.findings.front().verdict, Verdict::regression);
  EXPECT_THAT(result.headline(), HasSubstr("; by two launches: "));
  EXPECT_THAT(result.headline(), Not(HasSubstr("in doubt")));
  const auto advice = with(result, Verdict::advisory, Check::timing);
  ASSERT_EQ(advice.size(), 3U);
  EXPECT_THAT(advice[0].message, HasSubstr("not so on a fresh launch"));
  // What only the second shows is none of the first's.
  EXPECT_EQ(with(gate("c", "b"), Verdict::regression).size(), 3U);
}

// What the quieter launch's anchors say belongs to it.
TEST_F(TimingGateTest, TheAnchorsOfBothLaunchesAreTakenTogether) {
  accept_history_with_anchors();
  add_anchors("s-anchors", 1.3);
  add_run("s-run", times(1.3));
  add_anchors("t-anchors", 1);
  add_run("t-run");
  const GateResult result = gate("s-run", "t-run");
  EXPECT_EQ(result.measured_again.size(), 3U);
  EXPECT_EQ(with(result, Verdict::pass, Check::timing).size(), 12U + 3U) << text(result);
}

// Of a device that nobody asked about the first launch says it all.
TEST_F(TimingGateTest, ALaunchCountsOfTheDevicesAskedFor) {
  accept_history();
  add_run("b", times(1.2, plain_));
  add_run("c");
  const std::string one = *gate("b").in_doubt.begin();
  const GateResult result = gate("b", "c", std::set<std::string>{one});
  EXPECT_EQ(result.measured_again, std::set<std::string>{one});
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 2U) << text(result);
  for (const Finding& each : slower) EXPECT_NE(each.device, one);
}

// Not slower beyond doubt, and in doubt.
TEST_F(TimingGateTest, WhatMayBeSlowerIsInDoubtBeforeItIsARegression) {
  accept_history();
  bool doubted = false;
  for (int tenths = 20; tenths <= 50 && !doubted; ++tenths) {
    const std::string run = fmt::format("run{}", tenths);
    add_run(run, times(1 + 0.001 * tenths, plain_));
    const GateResult result = gate(run);
    doubted = !result.in_doubt.empty() && with(result, Verdict::regression).empty();
  }
  EXPECT_TRUE(doubted);
}

TEST_F(TimingGateTest, ARunLikeTheStoredOnesIsInNoDoubt) {
  accept_history();
  add_run("b");
  EXPECT_TRUE(gate("b").in_doubt.empty());
}

// Another program's times say nothing of this one.
TEST_F(TimingGateTest, ALaunchOfOtherCodeConfirmsNothing) {
  accept_history();
  add_run("b", times(1.2, plain_));
  add_run("c", [](record::Record& record, core::Image&) { record.kernel_hash += "-other"; });
  const GateResult result = gate("b", "c");
  EXPECT_TRUE(result.measured_again.empty());
  EXPECT_EQ(with(result, Verdict::regression).size(), 3U);
}

// The same of a run in the store that says which one it confirms.
TEST_F(TimingGateTest, ARunInTheStoreConfirms) {
  accept_history();
  add_run("b", [](record::Record& record, core::Image& image) {
    times(1.2, bricks_)(record, image);
    times(1.2, plain_)(record, image);
  });
  EXPECT_TRUE(gate("b").measured_again.empty());
  add_run("c", times(1.2, plain_));
  confirm("b", "c");
  const GateResult result = gate("b");
  EXPECT_EQ(result.measured_again.size(), 3U);
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 3U) << text(result);
  for (const Finding& each : slower) {
    EXPECT_EQ(each.configuration, plain_);
    EXPECT_THAT(each.message, HasSubstr("; so too on a fresh launch"));
  }
}

// Each of several may take back.
TEST_F(TimingGateTest, SlowerIsWhatEveryLaunchShows) {
  accept_history();
  add_run("b", times(1.2, plain_));
  add_run("c", times(1.2, plain_));
  add_run("d");
  confirm("b", "c");
  EXPECT_EQ(with(gate("b"), Verdict::regression).size(), 3U);
  confirm("b", "d");
  EXPECT_TRUE(with(gate("b"), Verdict::regression).empty());
}

// A device that was not measured again, or in part only, has been cleared of nothing.
TEST_F(TimingGateTest, HalfALaunchConfirmsNothing) {
  accept_history();
  add_run("b", times(1.2, plain_));
  const std::string cut_short = "vulkan:lavapipe";
  add_run("c", [&](record::Record& record, core::Image&) {
    if (record.device == cut_short && record.configuration != plain_) {
      record.outcome = record::Outcome::crashed;
    }
  });
  confirm("b", "c");
  const GateResult result = gate("b");
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 1U) << text(result);
  EXPECT_EQ(slower.front().device, cut_short);
  EXPECT_THAT(slower.front().message, Not(HasSubstr("fresh launch")));
}

// Only times may change from one launch to the next.
TEST_F(TimingGateTest, AFreshLaunchExcusesNoCounter) {
  accept_history();
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.configuration == plain_) record.counters["samples"] += 1;
  });
  add_run("c");
  confirm("b", "c");
  EXPECT_EQ(with(gate("b"), Verdict::regression, Check::counters).size(), 3U);
}

TEST_F(TimingGateTest, AnchorsThatNobodyAcceptedTellNothing) {
  accept_history();
  add_anchors("b-anchors", 1.3);
  add_run("b-run", times(1.3));
  EXPECT_EQ(with(gate("b-run"), Verdict::regression, Check::timing).size(), 12U);
}

TEST_F(TimingGateTest, ACoarseClockToleratesItsOwnStep) {
  const double step = 1e6;
  const auto coarse = [step](record::Record& record, core::Image&) {
    for (double& ns : record.wall_ns) ns = step * std::round(ns / step) + 10 * step;
    record.wall_ns.back() += step;  // the step is seen in the samples
  };
  accept_history(coarse);
  add_run("b", [&](record::Record& record, core::Image& image) {
    coarse(record, image);
    for (double& ns : record.wall_ns) ns += step;
  });
  const GateResult result = gate("b");
  EXPECT_TRUE(with(result, Verdict::regression).empty()) << text(result);
}

TEST_F(TimingGateTest, WildScatterIsUndecided) {
  core::Random random(3);
  const auto wild = [&](record::Record& record, core::Image&) {
    const double factor = std::exp(random.uniform(-1, 1));
    for (double& ns : record.wall_ns) ns *= factor;
  };
  accept_history(wild);
  add_run("b");
  const GateResult result = gate("b");
  ASSERT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  EXPECT_THAT(with(result, Verdict::cannot_judge, Check::timing).at(0).message,
              HasSubstr("settle it with triptych compare volume/quick"));
}

}  // namespace
}  // namespace triptych::judge
