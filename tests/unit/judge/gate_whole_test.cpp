// Tests the gate's findings about incomplete runs and baselines.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "core/image_io.hpp"
#include "gate_fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::HasSubstr;

TEST_F(GateTest, WithoutBaselinesTheCommandToAcceptIsPrinted) {
  add_run("a");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  ASSERT_EQ(with(result, Verdict::cannot_judge).size(), 1U) << text(result);
  const Finding finding = with(result, Verdict::cannot_judge).at(0);
  EXPECT_EQ(finding.cause, Cause::no_baselines);
  EXPECT_EQ(finding.advice.advice, Advice::accept);
  EXPECT_EQ(finding.advice.command, "triptych accept volume/quick --reason TEXT");
  EXPECT_FALSE(finding.fact("folder").empty());
}

// The default folder contains the baselines of the suites' plans, and may be a source checkout.
TEST_F(GateTest, AUsersPlanIsAcceptedInAFolderOfTheUser) {
  add_run("a");
  GateRequest request = request_;
  request.plan = "study";
  request.argument = "my/study.yaml";
  request.checks = {Check::image, Check::counters, Check::timing};
  const auto no_baselines = [&] {
    const GateResult result = gate("a", request);
    const auto found = std::ranges::find(result.findings, Cause::no_baselines, &Finding::cause);
    return found == result.findings.end() ? Finding{} : *found;
  };
  const Finding own = no_baselines();
  EXPECT_EQ(own.advice.advice, Advice::accept_own);
  EXPECT_EQ(own.advice.command,
            "triptych accept my/study.yaml --reason TEXT --baselines own-baselines");
  EXPECT_EQ(own.fact("folder"), "");
  EXPECT_EQ(own.fact("checked"), "image");
  EXPECT_THAT(own.names, testing::ElementsAre("counters", "timing"));
  request.baselines_option = " --baselines mine";
  EXPECT_EQ(no_baselines().advice.advice, Advice::accept);
}

// Commands are quoted for the shell, because users paste them.
TEST_F(GateTest, CommandsAreQuoted) {
  add_run("a");
  GateRequest request = request_;
  request.plan = "ev$(touch x)";
  EXPECT_THAT(text(gate("a", request)),
              HasSubstr("triptych accept 'FOLDER/ev$(touch x).yaml' --reason"));
  request.argument = "my/ev$(touch x).yaml";
  EXPECT_THAT(text(gate("a", request)),
              HasSubstr("triptych accept 'my/ev$(touch x).yaml' --reason"));
}

TEST_F(GateTest, AWrongImageIsFoundWithoutBaselines) {
  add_run("a", wrong_image_on("vulkan:lavapipe"));
  EXPECT_EQ(gate("a").exit_code(), ExitCode::regression);
}

TEST_F(GateTest, EmptyRunCannotBeJudged) {
  add_run("a");
  (void)accept_run("a");
  EXPECT_EQ(gate("unknown").exit_code(), ExitCode::cannot_judge);
  EXPECT_THAT(text(gate("unknown")), HasSubstr("nothing_measured"));
}

TEST_F(GateTest, ARunOfAnotherPlanCannotBeJudged) {
  add_run("a");
  (void)accept_run("a");
  request_.plan = "volume/paper";
  EXPECT_EQ(gate("a").exit_code(), ExitCode::cannot_judge);
}

TEST_F(GateTest, OnlySelectedDevicesAreJudged) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", wrong_image_on("vulkan:lavapipe"));
  request_.devices = {"gl:*", "opencl:*"};
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  request_.devices = {"metal:*"};
  EXPECT_EQ(gate("b").exit_code(), ExitCode::cannot_judge);
}

TEST_F(GateTest, ARequiredDeviceMustHaveMeasured) {
  add_run("a");
  (void)accept_run("a");
  request_.required_devices = {"vulkan:*", "gl:softpipe"};
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  ASSERT_EQ(with(result, Verdict::cannot_judge).size(), 1U);
  EXPECT_EQ(with(result, Verdict::cannot_judge).at(0).fact("glob"), "gl:softpipe");
}

// The device has a new driver, so all findings about it are advisory. The exit code is 2, and the
// reason must be printed.
TEST_F(GateTest, ADeviceWithoutAVerdictIsReported) {
  accept_first();
  driver_versions_["vulkan:lavapipe"] = "99";
  add_run("b");
  request_.checks = {Check::statistics};
  request_.devices = {"gl:*", "vulkan:*"};
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  const auto open = with(result, Verdict::cannot_judge);
  ASSERT_EQ(open.size(), 1U) << text(result);
  EXPECT_EQ(open[0].device, "vulkan:lavapipe");
  EXPECT_EQ(open[0].cause, Cause::nothing_decided);
  EXPECT_EQ(open[0].advice.command, "triptych accept volume/quick --reason TEXT");
}

// The gate passes, but it must not claim that every requested check passed.
TEST_F(GateTest, ChecksWithoutAVerdictAreListed) {
  accept_first();
  add_run("same");
  request_.checks = {Check::image, Check::counters, Check::statistics};
  EXPECT_TRUE(gate("same").undecided_checks().empty());
  driver_versions_["vulkan:lavapipe"] = "99";
  add_run("new");
  const GateResult result = gate("new");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const std::map<Check, std::set<std::string>> undecided{{Check::statistics, {"vulkan:lavapipe"}}};
  EXPECT_EQ(result.undecided_checks(), undecided);
  request_.devices = {"vulkan:lavapipe"};
  const std::map<Check, std::set<std::string>> nowhere{{Check::statistics, {}}};
  EXPECT_EQ(gate("new").undecided_checks(), nowhere);
}

TEST_F(GateTest, DriversThatWereNeverAcceptedAreMarked) {
  accept_first();
  driver_versions_["vulkan:lavapipe"] = "99";
  add_run("b");
  const auto tested = gate("b").tested;
  ASSERT_EQ(tested.size(), 3U);
  EXPECT_EQ(tested.at("vulkan:lavapipe").driver_version, "99");
  EXPECT_FALSE(tested.at("vulkan:lavapipe").accepted);
  EXPECT_TRUE(tested.at("opencl:pocl").accepted);
}

// The crashes explain why nothing was measured. Skips do not.
TEST_F(GateTest, NothingMeasuredIsNotReportedTogetherWithCrashes) {
  accept_first();
  const auto all_end = [](record::Outcome outcome) {
    return [outcome](record::Record& record, core::Image&) { record.outcome = outcome; };
  };
  add_run("crashed", all_end(record::Outcome::crashed));
  EXPECT_EQ(with(gate("crashed"), Cause::nothing_measured).size(), 0U) << text(gate("crashed"));
  EXPECT_EQ(gate("crashed").exit_code(), ExitCode::regression);
  add_run("skipped", all_end(record::Outcome::skipped));
  EXPECT_EQ(with(gate("skipped"), Cause::nothing_measured).size(), 1U) << text(gate("skipped"));
  write_waivers("2027-01-01", "*:*");
  request_.checks = {Check::image};
  EXPECT_EQ(gate("crashed").exit_code(), ExitCode::cannot_judge)
      << "a run without measurements must not pass because of waivers: " << text(gate("crashed"));
}

TEST_F(GateTest, AnIncompleteRunNamesTheCommandThatFinishesIt) {
  request_.resume_command = "triptych validate --resume";
  const GateResult result = gate("");
  ASSERT_EQ(with(result, Cause::no_run).size(), 1U);
  EXPECT_EQ(with(result, Cause::no_run)[0].advice.command, "triptych validate --resume");
}

TEST_F(GateTest, MissingRecordsAreReported) {
  add_run("a");
  (void)accept_run("a");
  store_.add_run({"part", plan, "2026-02-02T00:00:00Z", {}});
  for (record::Record record : store_.records("a")) {
    record.run = "part";
    if (record.device == "opencl:pocl" && record.configuration != bricks_)
      store_.add_record(record);
  }
  for (const auto& entry : store_.devices("a")) {
    if (entry.device.id == "opencl:pocl") store_.add_device("part", entry.device, {});
  }
  const GateResult result = gate("part");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  const auto missing = with(result, Verdict::cannot_judge);
  ASSERT_EQ(missing.size(), 1U) << text(result);
  EXPECT_EQ(missing[0].cause, Cause::missing);
  EXPECT_EQ(missing[0].number("wanted"), 4);
  EXPECT_EQ(missing[0].names, std::vector{bricks_});
}

TEST_F(GateTest, ARunOfAChangedPlanCannotBeJudged) {
  accept_first();
  plan_hash_ = "0a0a";
  add_run("b");
  request_.plan_hash = "0a0a";
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  request_.plan_hash = "1b1b";
  EXPECT_EQ(gate("b").exit_code(), ExitCode::cannot_judge);
  const Finding finding = with(gate("b"), Cause::other_plan).at(0);
  EXPECT_EQ(finding.fact("hash"), "0a0a");
  EXPECT_EQ(finding.fact("now"), "1b1b");
  EXPECT_EQ(with(gate("accepted"), Cause::other_plan).at(0).fact("hash"), "");
}

// The run must contain exactly the configurations of the plan.
TEST_F(GateTest, TheRunMustContainThePlansConfigurations) {
  accept_first();
  for (const auto& configuration : Baselines(folder_.path() / "baselines", plan).configurations()) {
    request_.expected.push_back(configuration);
  }
  EXPECT_EQ(gate("accepted").exit_code(), ExitCode::pass) << text(gate("accepted"));
  request_.expected.emplace_back("new");
  EXPECT_EQ(gate("accepted").exit_code(), ExitCode::cannot_judge);
  const Finding missing = with(gate("accepted"), Cause::missing).at(0);
  EXPECT_EQ(missing.number("wanted"), 5);
  EXPECT_EQ(missing.names, std::vector<std::string>{"new"});
  request_.expected = {plain_};
  EXPECT_EQ(gate("accepted").exit_code(), ExitCode::cannot_judge);
  EXPECT_EQ(with(gate("accepted"), Cause::extra).at(0).names.size(), 3U);
}

TEST_F(GateTest, ThePlanOfTheRunDeterminesTheChecks) {
  checks_ = {Check::counters};
  accept_first();
  for (const Finding& finding : gate("accepted").findings) {
    EXPECT_EQ(finding.check, Check::counters);
  }
}

TEST_F(GateTest, EveryFailedOutcomeIsReportedOnce) {
  add_run("a");
  (void)accept_run("a");
  using record::Outcome;
  for (const Outcome outcome : {Outcome::failed, Outcome::crashed, Outcome::hung, Outcome::lost}) {
    const std::string run(record::name_of(outcome));
    add_run(run, [&](record::Record& record, core::Image&) {
      if (record.device != "gl:llvmpipe-egl" || record.configuration != plain_) return;
      record.outcome = outcome;
      record.reason = {.cause = record::Cause::error, .detail = "because"};
    });
    const auto wrong = with(gate(run), Verdict::regression);
    ASSERT_EQ(wrong.size(), 1U);
    EXPECT_EQ(wrong[0].outcome, outcome);
    EXPECT_EQ(wrong[0].reason.detail, "because");
    EXPECT_EQ(wrong[0].check, Check::image);
  }
}

// A configuration with a broken data file cannot be judged, whether or not the device measured it
// before.
TEST_F(GateTest, BadInputCannotBeJudged) {
  const auto broken = [](record::Record& record, core::Image&) {
    if (record.configuration != bricks_) return;
    record.outcome = record::Outcome::skipped;
    record.reason = {.cause = record::Cause::bad_input, .detail = "a.nrrd:3: spacing 0"};
  };
  add_run("a", broken);
  (void)accept_run("a");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  const auto unjudged = with(result, Verdict::cannot_judge, Check::image);
  ASSERT_EQ(unjudged.size(), 3U);
  EXPECT_EQ(unjudged[0].reason.cause, record::Cause::bad_input);
  EXPECT_EQ(unjudged[0].reason.detail, "a.nrrd:3: spacing 0");
  EXPECT_TRUE(with(result, Verdict::regression).empty());
}

TEST_F(GateTest, ASkipIsAllowedUnlessTheDeviceMeasuredItBefore) {
  const auto skip = [](record::Record& record, core::Image&) {
    if (record.configuration != bricks_) return;
    record.outcome = record::Outcome::skipped;
    record.reason = {.cause = record::Cause::not_supported, .detail = "no bricks here"};
  };
  add_run("a", skip);
  (void)accept_run("a");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::skipped, Check::image).size(), 3U);
  EXPECT_EQ(with(result, Verdict::skipped, Check::image).at(0).reason.detail, "no bricks here");

  add_run("whole");
  (void)accept_run("whole");
  EXPECT_EQ(gate("a").exit_code(), ExitCode::cannot_judge);
  EXPECT_TRUE(with(gate("a"), Cause::ended).at(0).measured_before);
  settings_ = {{"LP_NUM_THREADS", "1"}};
  add_run("threads", skip);
  EXPECT_EQ(gate("threads").exit_code(), ExitCode::cannot_judge);
  settings_ = {{"MESA_GL_VERSION_OVERRIDE", "3.3"}};
  add_run("less", skip);
  EXPECT_EQ(gate("less").exit_code(), ExitCode::pass) << text(gate("less"));
}

TEST_F(GateTest, AnInjectedFaultIsReported) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image& image) {
    wrong_image_on("vulkan:lavapipe")(record, image);
    if (record.device == "vulkan:lavapipe") record.injected = "swap_axes";
  });
  EXPECT_EQ(with(gate("b"), Verdict::regression).at(0).injected,
            std::vector<std::string>{"swap_axes"});
}

}  // namespace
}  // namespace triptych::judge
