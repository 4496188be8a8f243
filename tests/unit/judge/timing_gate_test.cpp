// What the gate says of times, from records to verdict.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/file.hpp"
#include "judge/timing/anchor.hpp"
#include "timing_fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::HasSubstr;

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
              HasSubstr("timed by the device clock, as only 0 of 8 stored runs are"));
}

// Three runs by either clock, all of them by the wall as well.
TEST_F(TimingGateTest, AHistoryOfTwoClocksIsComparedByTheWall) {
  for (int run = 1; run <= 6; ++run) {
    add_run(fmt::format("{}", run), run <= 3 ? times(1) : by_the_device(times(1)));
    (void)accept_run(fmt::format("{}", run));
  }
  add_run("same", by_the_device(times(1)));
  EXPECT_EQ(with(gate("same"), Verdict::pass, Check::timing).size(), 12U) << text(gate("same"));
  add_run("slower", by_the_device(times(1.3, bricks_)));
  EXPECT_EQ(with(gate("slower"), Verdict::regression, Check::timing).size(), 3U);
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
  EXPECT_THAT(advice[0].message, HasSubstr("the device itself: +3"));
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
  EXPECT_THAT(whole->message, HasSubstr("the program as a whole: +"));
  EXPECT_NEAR(whole->numbers.at("ratio"), 1.3, 0.03);
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

// Frozen work tells how the device is, of no program.
TEST_F(TimingGateTest, ASlowerAnchorIsNoRegression) {
  accept_history_with_anchors();
  add_anchors("s-anchors", 1, 1.5);
  GateRequest request = request_;
  request.plan = anchors_plan;
  const GateResult result = judge_run(
      store_, "s-anchors", Baselines(folder_.path() / "baselines", request.plan), request);
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory, Check::timing);
  ASSERT_EQ(advice.size(), 3U) << text(result);
  EXPECT_NEAR(advice[0].numbers.at("ratio"), 1.5, 0.03);
  EXPECT_THAT(advice[0].message, HasSubstr("; the device, not the program"));
  EXPECT_TRUE(result.in_doubt.empty());
}

}  // namespace
}  // namespace triptych::judge
