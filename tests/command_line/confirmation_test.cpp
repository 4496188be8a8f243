// A suspect of one launch is measured again by a fresh one: by CTest's check of times, and by the
// gate where it is asked to.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/image_io.hpp"
#include "measure/plan.hpp"
#include "program.hpp"
#include "record/store.hpp"
#include "suites/volume/suite.hpp"

namespace triptych::command_line {
namespace {

class Confirmation : public testing::Test {
 protected:
  Confirmation() {
    program.write("plan",
                  "suite: volume\ntechnique: [raycast]\ndata: [generate:gaussian_blob:12]\n"
                  "transfer_function: [haze]\nskip: [none, bricks]\ncamera: [orbit_y:1/8]\n"
                  "viewport: [16]\n");
    const auto suite = volume_suite::make_suite({});
    const measure::Plan plan =
        measure::load_plan((program.folder() / "plan").string(), {},
                           [&](std::string_view) -> measure::Suite& { return *suite; });
    core::write_exr(suite->truth(plan.configurations.at(0), {}).image,
                    program.folder() / "right.exr");
  }

  void SetUp() override {
    for (int run = 0; run < 6; ++run) {
      const std::string store = fmt::format("--store history{}.sqlite", run);
      ASSERT_EQ(program.run("run plan --device 'null:*' " + store, script(1, run)).code, 0);
      ASSERT_EQ(
          program.run("accept plan --reason history --baselines baselines " + store, script(1, run))
              .code,
          0);
    }
  }

  // `speed`: factor on all times of a launch; `unskipped` on those that skip nothing.
  [[nodiscard]] std::string script(double speed, int seed, double unskipped = 1) const {
    return fmt::format(
        R"({{"images": {{"*": "{}"}}, "devices": [{}], "factors": {{"*skip=none*": {}}}, "seed": {}, )"
        R"("base_ns": 5e6, "noise": 0.003}})",
        (program.folder() / "right.exr").string(), speed, unskipped, seed);
  }

  // What the check says of a first launch, where a second is as fast as that.
  [[nodiscard]] Result check(double first, double second, double first_unskipped = 1) const {
    const Result measured = program.run("test-measure plan --device null:scripted --store s.sqlite",
                                        script(first, 50, first_unskipped));
    EXPECT_EQ(measured.code, 0) << measured.output;
    return check_again(second);
  }

  // The machine is one that is kept for measuring.
  [[nodiscard]] Result check_again(
      double speed, const std::string& wrapper = "env TRIPTYCH_JUDGE_TIMES=1") const {
    return program.run("test-check plan --check timing --device null:scripted --store s.sqlite",
                       script(speed, 51), wrapper);
  }

  // The runs of the plan in a store.
  [[nodiscard]] std::size_t runs(const std::string& store) const {
    return record::Store(program.folder() / store, record::Store::Mode::read).runs().size();
  }

  Program program;
};

constexpr const char* taken_back = ", not so on a fresh launch";

TEST_F(Confirmation, ALaunchLikeTheStoredOnesNeedsNoSecond) {
  const Result result = check(1, 1.5);
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_EQ(runs("s.sqlite"), 1U);
}

// What was confirmed once is not measured again, and anybody who reads the store knows it.
TEST_F(Confirmation, TheVerdictIsInTheStore) {
  EXPECT_EQ(check(1.25, 1.25).code, 1);
  EXPECT_EQ(runs("s.sqlite"), 2U);
  EXPECT_EQ(check_again(1).code, 1);
  EXPECT_EQ(runs("s.sqlite"), 2U);
}

TEST_F(Confirmation, TheGateMeasuresSuspectsAgainWhereItIsAsked) {
  const std::string gate = "gate plan --baselines baselines --store g.sqlite ";
  ASSERT_EQ(program.run("run plan --device 'null:*' --store g.sqlite", script(1, 50, 1.25)).code,
            0);
  EXPECT_EQ(program.run(gate, script(1, 51)).code, 1);
  EXPECT_EQ(runs("g.sqlite"), 1U);
  const Result confirmed = program.run(gate + "--confirm", script(1, 51));
  EXPECT_EQ(confirmed.code, 0) << confirmed.output;
  EXPECT_EQ(runs("g.sqlite"), 2U);
  EXPECT_EQ(program.run(gate, script(1, 51)).code, 0);
  // Nothing is left that would be measured again.
  EXPECT_EQ(program.run(gate + "--confirm", script(1, 51)).code, 0);
  EXPECT_EQ(runs("g.sqlite"), 2U);
}

TEST_F(Confirmation, TheGateKeepsWhatBothLaunchesShow) {
  ASSERT_EQ(program.run("run plan --device 'null:*' --store g.sqlite", script(1.25, 50)).code, 0);
  const Result confirmed = program.run(
      "gate plan --baselines baselines --store g.sqlite --confirm --json", script(1.25, 51));
  EXPECT_EQ(confirmed.code, 1) << confirmed.output;
  EXPECT_NE(confirmed.output.find("; so too on a fresh launch"), std::string::npos)
      << confirmed.output;
}

// The store knows a file's plan by its stem, which is nothing that could be measured again.
TEST_F(Confirmation, TheGateMeasuresThePlanOfAFileAgain) {
  std::filesystem::create_directory(program.folder() / "plans");
  std::filesystem::rename(program.folder() / "plan", program.folder() / "plans/plan.yaml");
  ASSERT_EQ(
      program.run("run plans/plan.yaml --device 'null:*' --store g.sqlite", script(1, 50, 1.25))
          .code,
      0);
  const Result confirmed = program.run(
      "gate plans/plan.yaml --baselines baselines --store g.sqlite --confirm", script(1, 51));
  EXPECT_EQ(confirmed.code, 0) << confirmed.output;
  EXPECT_EQ(runs("g.sqlite"), 2U);
}

// A regression is none the less one for a driver or a plan that is there no more.
TEST_F(Confirmation, WhatCannotBeConfirmedStands) {
  ASSERT_EQ(program.run("run plan --device 'null:*' --store g.sqlite", script(1.25, 50)).code, 0);
  const std::string gate =
      "gate plan --baselines baselines --store g.sqlite --confirm --junit j.xml --markdown m.md ";
  const Result without_device = program.run(gate, R"({"devices": []})");
  EXPECT_EQ(without_device.code, 1) << without_device.output;
  EXPECT_NE(without_device.output.find("could not confirm: no device matches null:scripted"),
            std::string::npos)
      << without_device.output;
  EXPECT_NE(program.read("j.xml").find("<failure"), std::string::npos);
  EXPECT_NE(program.read("m.md").find("FAIL"), std::string::npos);
  std::filesystem::remove(program.folder() / "plan");
  const Result without_plan = program.run(gate, script(1.25, 51));
  EXPECT_EQ(without_plan.code, 1) << without_plan.output;
  EXPECT_NE(without_plan.output.find("could not confirm: plan: cannot be read"), std::string::npos)
      << without_plan.output;
}

TEST_F(Confirmation, SlowInBothLaunchesIsARegression) {
  const Result result = check(1.25, 1.25);
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_EQ(result.output.find(taken_back), std::string::npos) << result.output;
}

// On any other machine a slow day fails no test, and passes none.
TEST_F(Confirmation, SlowIsASkipWhereNobodyAskedForTimes) {
  EXPECT_EQ(check(1.25, 1.25).code, 1);
  const Result result = check_again(1.25, "env -u TRIPTYCH_JUDGE_TIMES");
  EXPECT_EQ(result.code, 77) << result.output;
  EXPECT_NE(result.output.find("slower than stored, in two launches"), std::string::npos)
      << result.output;
}

TEST_F(Confirmation, ACrashIsNoSlowness) {
  const std::string crash =
      "test-measure plan --device null:scripted --store s.sqlite --plant "
      "'crash@*skip=none*'";
  EXPECT_EQ(program.run(crash, script(1, 50)).code, 1);
  const Result result = check_again(1, "env -u TRIPTYCH_JUDGE_TIMES");
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_EQ(runs("s.sqlite"), 1U);
}

TEST_F(Confirmation, SlowInOneLaunchIsNone) {
  const Result result = check(1, 1, 1.25);
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find(taken_back), std::string::npos) << result.output;
}

// What was planted in the first launch is another program.
TEST_F(Confirmation, AnotherProgramConfirmsNothing) {
  ASSERT_EQ(program
                .run("run plan --device 'null:*' --store g.sqlite --plant "
                     "'slowdown:25@*skip=none*'",
                     script(1, 50))
                .code,
            0);
  const Result result =
      program.run("gate plan --baselines baselines --store g.sqlite --confirm", script(1, 51));
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_EQ(result.output.find(taken_back), std::string::npos) << result.output;
}

// Nothing is left that was judged: a skip, with the reason.
TEST_F(Confirmation, AllSlowInOneLaunchIsNoPassEither) {
  const Result result = check(1.25, 1);
  EXPECT_EQ(result.code, 77) << result.output;
  EXPECT_NE(result.output.find(taken_back), std::string::npos) << result.output;
}

// A slow day is no failure, and no pass: where most stored runs scatter nothing can be told.
TEST_F(Confirmation, TooNoisyToTellIsASkip) {
  for (const double speed : {0.6, 1.5, 0.8, 1.9, 0.7, 1.3, 0.75, 1.7}) {
    const std::string store = fmt::format("--store noisy{}.sqlite", speed);
    ASSERT_EQ(program.run("run plan --device 'null:*' " + store, script(speed, 9)).code, 0);
    ASSERT_EQ(program.run("accept plan --reason noise --baselines baselines " + store).code, 0);
  }
  const Result result = check(1.1, 1.1);
  EXPECT_EQ(result.code, 77) << result.output;
  EXPECT_NE(result.output.find("settle it with triptych compare"), std::string::npos)
      << result.output;
  EXPECT_EQ(program.run("gate plan --baselines baselines --store s.sqlite", script(1.1, 50)).code,
            2);
}

// It takes findings back and never adds any.
TEST_F(Confirmation, ASecondLaunchAddsNoSuspect) {
  const Result result = check(1, 1.25, 1.25);
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_NE(result.output.find("1 regression"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace triptych::command_line
