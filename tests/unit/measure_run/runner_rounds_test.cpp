// Runs of several rounds: a machine that was busy during the first shows in no record.

#include <array>

#include "measure/device_run.hpp"
#include "tests/unit/measure_run/run_fixture.hpp"

namespace triptych::measure {
namespace {

using record::Outcome;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class RunRounds : public RunTest {
 protected:
  static double median_ns(const record::Record& record) {
    return record::summarise(record.wall_ns)->median;
  }

  Variable busy{"TRIPTYCH_NULL_SCRIPT",
                R"({"base_ns": 3e6, "ns_per_sample": 0, "prepare_factors": [3]})"};
};

TEST_F(RunRounds, OneRoundBelievesWhatItSaw) {
  const RunResult result = run(small_plan());
  for (const record::Record& record : records(result.run)) {
    EXPECT_THAT(record.rounds_ns, SizeIs(1));
    EXPECT_EQ(median_ns(record), 9e6);
  }
}

TEST_F(RunRounds, SeveralFindTheQuietTimeAndStopWhenItWasSeenAgain) {
  Plan what = small_plan();
  what.rounds = 6;
  const RunResult result = run(what);
  EXPECT_EQ(result.measured, 4);
  EXPECT_EQ(result.unsettled, 0);
  EXPECT_THAT(told, SizeIs(4 * 4));
  EXPECT_THAT(started_workers(), SizeIs(1));
  const auto all = records(result.run);
  ASSERT_THAT(all, SizeIs(4));
  constexpr double quiet_ns = 3e6 * 0.98;
  for (const record::Record& record : all) {
    EXPECT_EQ(median_ns(record), 3e6);
    EXPECT_THAT(record.wall_ns, SizeIs(8));
    EXPECT_THAT(record.rounds_ns, ElementsAre(9e6 * 0.98, quiet_ns, quiet_ns, quiet_ns));
    EXPECT_FALSE(record.counters.empty() || record.image.empty());
  }
}

TEST_F(RunRounds, TheOptionGoesOverThePlanAndTellsWhatIsNotSettled) {
  Plan what = small_plan();
  what.rounds = 6;
  options.rounds = 2;
  const RunResult result = run(what);
  EXPECT_THAT(told, SizeIs(2 * 4));
  EXPECT_EQ(result.unsettled, 4);
}

TEST_F(RunRounds, ASpentBudgetMakesTheFirstRoundAlone) {
  options.budget = std::chrono::seconds(0);
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.measured, 4);
  EXPECT_THAT(told, SizeIs(4));
}

TEST_F(RunRounds, ABudgetGoesOnUntilAllIsSettled) {
  options.budget = std::chrono::seconds(60);
  EXPECT_EQ(run(small_plan()).unsettled, 0);
  EXPECT_THAT(told, SizeIs(4 * 4));
}

TEST_F(RunRounds, OneEndsWhenTheTimeWasSeenAgainElseAfterItsTime) {
  const Variable quiet("TRIPTYCH_NULL_SCRIPT", R"({"base_ns": 3e6, "ns_per_sample": 0})");
  const Plan what = small_plan();
  const RunResult result = run(what);
  record::Record record = records(result.run).front();
  record::Store store = open_store();
  InterruptGuard interrupts;
  const RunContext context{what, suite, store, options, interrupts, result.run, {}};
  DeviceRun device(context, record.device);
  const auto passes = [&] {
    return device.round(what.configurations.front(), record, {}).passes.size();
  };
  EXPECT_EQ(passes(), 1U);
  record.rounds_ns = {1e6};
  EXPECT_EQ(passes(), 11U);  // eight frames of 3 ms each, 250 ms at least
}

TEST_F(RunRounds, ThoseOfPlansMeasuredTogetherAlternate) {
  Plan one = plan({{"technique", {"raycast"}}, {"data", {"cube"}}, {"camera", {"orbit_x:1/2"}}});
  Plan other = plan({{"technique", {"raycast"}}, {"data", {"cube"}}, {"camera", {"orbit_y:1/2"}}});
  one.rounds = 2;
  other.rounds = 3;
  record::Store store = open_store();
  const std::array together{PlannedRun{one, suite, options}, PlannedRun{other, suite, options}};
  const auto results =
      run_plans(together, {"null:scripted"}, store,
                [this](const Progress& told_of) { told.push_back(told_of.configuration); });
  ASSERT_THAT(results, SizeIs(2));
  EXPECT_NE(results[0].run, results[1].run);
  EXPECT_EQ(results[0].measured, 2);
  EXPECT_EQ(results[1].measured, 2);
  const std::vector<std::string> first(told.begin(), told.begin() + 2);
  const std::vector<std::string> second(told.begin() + 2, told.begin() + 4);
  EXPECT_NE(first, second);
  std::vector<std::string> expected;
  for (const auto* part : {&first, &second, &first, &second, &second}) {
    expected.insert(expected.end(), part->begin(), part->end());
  }
  EXPECT_EQ(told, expected);
  for (const record::Record& record : records(results[1].run)) {
    EXPECT_THAT(record.rounds_ns, SizeIs(3));
  }
}

TEST_F(RunRounds, AResumedRunGoesOnWithItsRounds) {
  const RunResult first = run(small_plan());
  options.resume = true;
  options.rounds = 3;
  const RunResult second = run(small_plan());
  EXPECT_EQ(second.run, first.run);
  EXPECT_EQ(second.measured, 4);
  EXPECT_EQ(second.there_before, 4);
  EXPECT_EQ(second.rounds_added, 2 * 4);
  for (const record::Record& record : records(first.run)) {
    EXPECT_THAT(record.rounds_ns, SizeIs(3));
  }
}

TEST_F(RunRounds, OneThatFailsInAResumedRunIsNoLongerMeasured) {
  const Plan what =
      plan({{"technique", {"raycast"}}, {"data", {"cube"}}, {"camera", {"random:7"}}});
  ASSERT_EQ(run(what).measured, 2);
  const Variable failing("TRIPTYCH_NULL_SCRIPT",
                         R"({"base_ns": 3e6, "failures":
                             [{"kind": "crash", "at": "prepare", "only": "*step=0.5*"}]})");
  options.resume = true;
  options.rounds = 2;
  const RunResult result = run(what);
  EXPECT_EQ(result.measured, 1);
  EXPECT_EQ(result.failed, 1);
}

TEST_F(RunRounds, OneThatFailsLaterWasMeasuredByLuck) {
  const Variable failing("TRIPTYCH_NULL_SCRIPT",
                         R"({"base_ns": 3e6, "failures":
                             [{"kind": "crash", "at": "prepare", "frame": 1, "only": "*step=0.5*"}]})");
  options.rounds = 3;
  const RunResult result =
      run(plan({{"technique", {"raycast"}}, {"data", {"cube"}}, {"camera", {"random:7"}}}));
  EXPECT_EQ(result.measured, 1);
  EXPECT_EQ(result.failed, 1);
  for (const record::Record& record : records(result.run)) {
    if (record.outcome == Outcome::measured) continue;
    EXPECT_EQ(record.outcome, Outcome::crashed);
    EXPECT_THAT(record.reason, AllOf(HasSubstr("in round 2: "), HasSubstr("SIGABRT")));
  }
}

TEST_F(RunRounds, PicturesAloneHaveNoRounds) {
  Plan what = small_plan();
  what.timed = false;
  what.rounds = 3;
  const RunResult result = run(what);
  EXPECT_THAT(told, SizeIs(4));
  EXPECT_EQ(result.unsettled, 0);
}

TEST_F(RunRounds, AnUntimedRunHasNoneAndCalibratesNothing) {
  options.protocol.timed = false;
  const RunResult result = run(small_plan());
  EXPECT_THAT(told, SizeIs(4));
  for (const record::Record& record : records(result.run)) {
    EXPECT_TRUE(record.untimed());
    EXPECT_FALSE(record.image.empty());
    EXPECT_FALSE(record.counters.empty());
    EXPECT_TRUE(record.rounds_ns.empty());
  }
  for (const auto& entry : open_store().devices(result.run)) EXPECT_TRUE(entry.clocks.empty());
}

}  // namespace
}  // namespace triptych::measure
