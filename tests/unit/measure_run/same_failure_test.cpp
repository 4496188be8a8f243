#include "measure/run/same_failure.hpp"

#include "record/not_tried.hpp"
#include "tests/unit/measure_run/run_fixture.hpp"

namespace triptych::measure {
namespace {

using record::Outcome;
using ::testing::HasSubstr;
using ::testing::Not;

record::Record ended(Outcome outcome, const std::string& reason) {
  record::Record record;
  record.outcome = outcome;
  record.reason = reason;
  return record;
}

Configuration raycast(const std::string& data, const std::string& step,
                      const std::string& camera = "random:7") {
  return {{"technique", "raycast"}, {"data", data}, {"step", step}, {"camera", camera}};
}

TEST(SameFailure, TwoAlikeForetellTheRestThatSharesTheirLevels) {
  SameFailure failures({"data", "step"});
  failures.saw(raycast("ball", "1"), ended(Outcome::crashed, "SIGSEGV at 0x12"));
  EXPECT_FALSE(failures.foretold(raycast("ball", "2"))) << "one is no rule";
  failures.saw(raycast("ball", "2"), ended(Outcome::crashed, "SIGSEGV at 0x34"));
  const auto end = failures.foretold(raycast("ball", "3"));
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::crashed);
  EXPECT_THAT(end->reason, HasSubstr("SIGSEGV"));
  EXPECT_THAT(end->reason, HasSubstr("data=ball"));
  EXPECT_THAT(end->reason, Not(HasSubstr("step=")));
  EXPECT_FALSE(failures.foretold(raycast("cube", "3"))) << "it may be the data's";
  failures.saw(raycast("cube", "1"), ended(Outcome::crashed, "SIGSEGV at 0x56"));
  EXPECT_TRUE(failures.foretold(raycast("cube", "3"))) << "it is not the data's";
}

TEST(SameFailure, WhereNothingIsSharedNothingIsNamed) {
  SameFailure failures({"step"});
  failures.saw(raycast("ball", "1"), ended(Outcome::crashed, "SIGSEGV"));
  failures.saw(raycast("ball", "2"), ended(Outcome::crashed, "SIGSEGV"));
  EXPECT_EQ(failures.foretold(raycast("ball", "3")).value().reason,
            "SIGSEGV; not tried, as others ended so");
}

// What does not matter to one case does not to the next: that one is paid for once.
TEST(SameFailure, WhatDoesNotMatterIsRemembered) {
  SameFailure failures({"data", "step"});
  for (const char* step : {"1", "2", "3"}) {
    failures.saw(raycast("box", step), ended(Outcome::measured, ""));
  }
  failures.saw(raycast("ball", "1"), ended(Outcome::crashed, "SIGSEGV"));
  failures.saw(raycast("ball", "2"), ended(Outcome::crashed, "SIGSEGV"));
  EXPECT_FALSE(failures.foretold(raycast("cube", "1"))) << "boxes are drawn";
  failures.saw(raycast("cube", "1"), ended(Outcome::crashed, "SIGSEGV"));
  EXPECT_TRUE(failures.foretold(raycast("cube", "2")));
  EXPECT_FALSE(failures.foretold(raycast("torus", "1"))) << "boxes are drawn";
}

TEST(SameFailure, WhatWasMeasuredRefutesIt) {
  SameFailure failures({"data", "step"});
  failures.saw(raycast("ball", "3"), ended(Outcome::measured, ""));
  failures.saw(raycast("ball", "1"), ended(Outcome::crashed, "SIGSEGV"));
  failures.saw(raycast("ball", "2"), ended(Outcome::crashed, "SIGSEGV"));
  EXPECT_FALSE(failures.foretold(raycast("ball", "4")));
}

TEST(SameFailure, OtherWordsAreAnotherFailure) {
  SameFailure failures({"data", "step"});
  failures.saw(raycast("ball", "1"), ended(Outcome::crashed, "SIGSEGV"));
  failures.saw(raycast("ball", "2"), ended(Outcome::crashed, "SIGILL"));
  failures.saw(raycast("ball", "3"), ended(Outcome::hung, "SIGSEGV"));
  failures.saw(raycast("ball", "4"), ended(Outcome::failed, "VK_ERROR"));
  failures.saw(raycast("ball", "5"), ended(Outcome::failed, "VK_ERROR"));
  EXPECT_FALSE(failures.foretold(raycast("ball", "6")));
}

TEST(SameFailure, WhatWasNotTriedIsNoWitness) {
  SameFailure failures({"data", "step"});
  failures.saw(raycast("ball", "1"), ended(Outcome::crashed, "SIGSEGV"));
  failures.saw(raycast("cube", "1"),
               ended(Outcome::crashed, "SIGSEGV" + std::string(record::not_tried) + "step=1"));
  EXPECT_FALSE(failures.foretold(raycast("box", "1")));
}

class SameFailureRun : public RunTest {};

// Six configurations of two data sets; every one of the cube's ends its worker.
TEST_F(SameFailureRun, IsPaidForTwice) {
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
    EXPECT_THAT(record.reason, HasSubstr("SIGSEGV"));
    if (record::was_not_tried(record)) ++passed_by;
  }
  EXPECT_EQ(passed_by, 1);

  options.resume = true;
  EXPECT_EQ(run(what).failed, 3);
  EXPECT_EQ(started_workers().size(), 2U) << "a resumed run tries nothing anew";
}

}  // namespace
}  // namespace triptych::measure
