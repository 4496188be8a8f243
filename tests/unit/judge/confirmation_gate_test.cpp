// What a second launch settles, and when one is asked for.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "core/random.hpp"
#include "timing_fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::HasSubstr;
using testing::Not;

using ConfirmationGateTest = TimingGateTest;

// Of two launches the quieter one counts, of each thing for itself.
TEST_F(ConfirmationGateTest, ASecondLaunchConfirmsOnlyWhatItShowsToo) {
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
TEST_F(ConfirmationGateTest, TheAnchorsOfBothLaunchesAreTakenTogether) {
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
TEST_F(ConfirmationGateTest, ALaunchCountsOfTheDevicesAskedFor) {
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
TEST_F(ConfirmationGateTest, WhatMayBeSlowerIsInDoubtBeforeItIsARegression) {
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

TEST_F(ConfirmationGateTest, ARunLikeTheStoredOnesIsInNoDoubt) {
  accept_history();
  add_run("b");
  EXPECT_TRUE(gate("b").in_doubt.empty());
}

// Another program's times say nothing of this one.
TEST_F(ConfirmationGateTest, ALaunchOfOtherCodeConfirmsNothing) {
  accept_history();
  add_run("b", times(1.2, plain_));
  add_run("c", [](record::Record& record, core::Image&) { record.kernel_hash += "-other"; });
  const GateResult result = gate("b", "c");
  EXPECT_TRUE(result.measured_again.empty());
  EXPECT_EQ(with(result, Verdict::regression).size(), 3U);
}

// The same of a run in the store that says which one it confirms.
TEST_F(ConfirmationGateTest, ARunInTheStoreConfirms) {
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
TEST_F(ConfirmationGateTest, SlowerIsWhatEveryLaunchShows) {
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
TEST_F(ConfirmationGateTest, HalfALaunchConfirmsNothing) {
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
TEST_F(ConfirmationGateTest, AFreshLaunchExcusesNoCounter) {
  accept_history();
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.configuration == plain_) record.counters["samples"] += 1;
  });
  add_run("c");
  confirm("b", "c");
  EXPECT_EQ(with(gate("b"), Verdict::regression, Check::counters).size(), 3U);
}

// A quieter launch may tell.
TEST_F(ConfirmationGateTest, WhatNoiseLeavesOpenIsInDoubt) {
  core::Random random(3);
  const auto wild = [&](record::Record& record, core::Image& image) {
    if (record.device == "vulkan:lavapipe") {
      times(std::exp(random.uniform(-0.3, 0.3)), plain_)(record, image);
    }
  };
  accept_history(wild);
  add_run("b");
  const GateResult result = gate("b");
  ASSERT_EQ(with(result, Verdict::cannot_judge, Check::timing).size(), 1U) << text(result);
  EXPECT_EQ(result.in_doubt, std::set<std::string>{"vulkan:lavapipe"});
}

}  // namespace
}  // namespace triptych::judge
