#include "measure/run/failure_predictor.hpp"

#include <csignal>

#include "tests/unit/measure_run/run_fixture.hpp"

namespace triptych::measure {
namespace {

using record::Cause;
using record::Outcome;
using record::Reason;

record::Record ended(Outcome outcome, const Reason& reason) {
  record::Record record;
  record.outcome = outcome;
  record.reason = reason;
  return record;
}

Reason killed(int signal, const std::string& last_output = {}) {
  return {.cause = Cause::signal,
          .numbers = {{"signal", static_cast<double>(signal)}},
          .last_output = last_output};
}
const Reason segv = killed(SIGSEGV);
const Reason api{.cause = Cause::api_error, .subject = "vkCreate", .code = "VK_ERROR"};

Configuration raycast(const std::string& data, const std::string& step,
                      const std::string& camera = "random:7") {
  return {{"technique", "raycast"}, {"data", data}, {"step", step}, {"camera", camera}};
}

TEST(FailurePredictor, TwoEqualFailuresPredictOthersWithTheirLevels) {
  FailurePredictor failures({"data", "step"});
  failures.add(raycast("ball", "1"), ended(Outcome::crashed, killed(SIGSEGV, "at 0x12")));
  EXPECT_FALSE(failures.predict(raycast("ball", "2")))
      << "a single failure must not predict others";
  failures.add(raycast("ball", "2"), ended(Outcome::crashed, killed(SIGSEGV, "at 0x34")));
  const auto end = failures.predict(raycast("ball", "3"));
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::crashed);
  EXPECT_TRUE(end->reason.not_tried);
  EXPECT_TRUE(record::is_same_kind(end->reason, segv));
  EXPECT_EQ(end->reason.shared_levels, "data=ball");
  EXPECT_FALSE(failures.predict(raycast("cube", "3"))) << "the cause may lie in the data";
  failures.add(raycast("cube", "1"), ended(Outcome::crashed, killed(SIGSEGV, "at 0x56")));
  EXPECT_TRUE(failures.predict(raycast("cube", "3"))) << "the cause does not lie in the data";
}

TEST(FailurePredictor, WithoutSharedLevelsNothingIsPredicted) {
  FailurePredictor failures({"step"});
  failures.add(raycast("ball", "1"), ended(Outcome::crashed, segv));
  failures.add(raycast("ball", "2"), ended(Outcome::crashed, segv));
  const Reason reason = failures.predict(raycast("ball", "3")).value().reason;
  EXPECT_TRUE(reason.not_tried);
  EXPECT_EQ(reason.shared_levels, "");
}

// If a factor turned out to be irrelevant to one failure, it is assumed to be irrelevant to the
// next failure as well, so the next failure needs to be tried only once.
TEST(FailurePredictor, IrrelevantFactorsAreRemembered) {
  FailurePredictor failures({"data", "step"});
  for (const char* step : {"1", "2", "3"}) {
    failures.add(raycast("box", step), ended(Outcome::measured, {}));
  }
  failures.add(raycast("ball", "1"), ended(Outcome::crashed, segv));
  failures.add(raycast("ball", "2"), ended(Outcome::crashed, segv));
  EXPECT_FALSE(failures.predict(raycast("cube", "1")))
      << "boxes were drawn, so other data must be tried";
  failures.add(raycast("cube", "1"), ended(Outcome::crashed, segv));
  EXPECT_TRUE(failures.predict(raycast("cube", "2")));
  EXPECT_FALSE(failures.predict(raycast("torus", "1")))
      << "boxes were drawn, so other data must be tried";
}

TEST(FailurePredictor, AMeasurementRefutesAPrediction) {
  FailurePredictor failures({"data", "step"});
  failures.add(raycast("ball", "3"), ended(Outcome::measured, {}));
  failures.add(raycast("ball", "1"), ended(Outcome::crashed, segv));
  failures.add(raycast("ball", "2"), ended(Outcome::crashed, segv));
  EXPECT_FALSE(failures.predict(raycast("ball", "4")));
}

TEST(FailurePredictor, AnotherCauseIsAnotherFailure) {
  FailurePredictor failures({"data", "step"});
  failures.add(raycast("ball", "1"), ended(Outcome::crashed, segv));
  failures.add(raycast("ball", "2"), ended(Outcome::crashed, killed(SIGILL)));
  failures.add(raycast("ball", "3"), ended(Outcome::hung, segv));
  failures.add(raycast("ball", "4"), ended(Outcome::failed, api));
  failures.add(raycast("ball", "5"), ended(Outcome::failed, api));
  EXPECT_FALSE(failures.predict(raycast("ball", "6")));
}

TEST(FailurePredictor, UntriedConfigurationsProveNothing) {
  FailurePredictor failures({"data", "step"});
  failures.add(raycast("ball", "1"), ended(Outcome::crashed, segv));
  failures.add(raycast("cube", "1"), ended(Outcome::crashed, {.cause = Cause::signal,
                                                              .numbers = segv.numbers,
                                                              .not_tried = true,
                                                              .shared_levels = "step=1"}));
  EXPECT_FALSE(failures.predict(raycast("box", "1")));
}

class FailurePredictorRun : public RunTest {};

// Six configurations use two data sets. The three configurations with the cube crash their worker.
TEST_F(FailurePredictorRun, OccursOnlyTwice) {
  const Plan what = plan({{"technique", {"raycast"}},
                          {"data", {"ball", "cube"}},
                          {"step", {"0.5", "1", "2"}},
                          {"camera", {"random:7"}}});
  options.faults = {{"crash", "*data=cube*"}};
  const RunResult result = run(what);
  EXPECT_EQ(result.measured, 3);
  EXPECT_EQ(result.failed, 3);
  EXPECT_EQ(started_workers().size(), 2U);
  int passed_by = 0;
  for (const record::Record& record : records(result.run)) {
    if (record.outcome == Outcome::measured) continue;
    EXPECT_EQ(record.outcome, Outcome::crashed);
    EXPECT_EQ(record.reason.number("signal"), SIGSEGV);
    if (record.reason.not_tried) ++passed_by;
  }
  EXPECT_EQ(passed_by, 1);

  options.resume = true;
  EXPECT_EQ(run(what).failed, 3);
  EXPECT_EQ(started_workers().size(), 2U)
      << "a resumed run must not try failed configurations again";
}

}  // namespace
}  // namespace triptych::measure
