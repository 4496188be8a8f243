// Tests known failures: one run writes them to a file, and the next run expects them.

#include <gmock/gmock.h>

#include "core/file.hpp"
#include "gate_fixture.hpp"
#include "judge/gate/flakes.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using ::testing::SizeIs;

constexpr const char* known_device = "vulkan:lavapipe";

class KnownGateTest : public GateTest {
 protected:
  KnownGateTest() {
    request_.checks = {Check::image};
    add_run("accepted");
    (void)accept_run("accepted");
  }

  // Writes the known failures of a result to a file, and reads them back.
  [[nodiscard]] std::vector<Waiver> rewritten_outcomes(const GateResult& result) const {
    const auto file = folder_.path() / "known.json";
    core::write_file(expected_outcomes_text(expected_outcomes_of(
                         {&result, 1}, [](const Finding&) { return "words"; })),
                     file);
    return read_expected_outcomes(file);
  }

  static JudgeTest::Tweak skipped_on(const std::string& device) {
    return [device](record::Record& record, core::Image&) {
      if (record.device != device || record.configuration != plain_) return;
      record.outcome = record::Outcome::skipped;
      record.reason = {.cause = record::Cause::not_supported, .detail = "no geometry shaders"};
    };
  }
};

TEST_F(KnownGateTest, AFailureIsWaivedTheNextTime) {
  add_run("b", wrong_image_on(known_device));
  const GateResult first = gate("b");
  EXPECT_EQ(first.exit_code(), ExitCode::regression);
  request_.expected_outcomes = rewritten_outcomes(first);
  ASSERT_THAT(*request_.expected_outcomes, SizeIs(1));
  const GateResult second = gate("b");
  EXPECT_EQ(second.exit_code(), ExitCode::pass) << text(second);
  ASSERT_THAT(with(second, Verdict::waived), SizeIs(1));
  EXPECT_EQ(with(second, Verdict::waived).at(0).excuse.kind, Excuse::Kind::known);
  // The next run writes the same file, because waived failures remain known.
  EXPECT_EQ(expected_outcomes_text(rewritten_outcomes(second)),
            expected_outcomes_text(*request_.expected_outcomes));
}

TEST_F(KnownGateTest, ANewFailureIsARegression) {
  request_.expected_outcomes.emplace();
  add_run("b", wrong_image_on(known_device));
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
  // Failures of other configurations, devices or checks are new.
  add_run("c", wrong_image_on("opencl:pocl"));
  request_.expected_outcomes = rewritten_outcomes(gate("c"));
  EXPECT_EQ(gate("c").exit_code(), ExitCode::pass);
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

TEST_F(KnownGateTest, AnUnexpectedPassIsReported) {
  add_run("b", wrong_image_on(known_device));
  request_.expected_outcomes = rewritten_outcomes(gate("b"));
  const GateResult repaired = gate("accepted");
  EXPECT_EQ(repaired.exit_code(), ExitCode::pass);
  ASSERT_THAT(with(repaired, Verdict::improved), SizeIs(1));
  const Finding finding = with(repaired, Verdict::improved).at(0);
  EXPECT_EQ(finding.excuse.kind, Excuse::Kind::unexpected);
  EXPECT_EQ(finding.excuse.outcome, ExpectedOutcome::fail);
  EXPECT_EQ(finding.advice.advice, Advice::remove_entry);
}

TEST_F(KnownGateTest, AnUnexpectedSkipDoesNotPass) {
  add_run("b", skipped_on(known_device));
  AcceptRequest request;
  request.only = plain_;
  request.drop = true;
  (void)accept_run("b", request);
  ASSERT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  request_.expected_outcomes = rewritten_outcomes(gate("b"));
  ASSERT_THAT(*request_.expected_outcomes, SizeIs(1));
  EXPECT_EQ(request_.expected_outcomes->front().outcome, ExpectedOutcome::skip);
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  // If a configuration with a known skip is drawn, it counts as improved.
  EXPECT_THAT(with(gate("accepted"), Verdict::improved), SizeIs(1));
  request_.expected_outcomes->clear();
  EXPECT_EQ(gate("b").exit_code(), ExitCode::cannot_judge);
  EXPECT_EQ(with(gate("b"), Verdict::cannot_judge).at(0).excuse.kind, Excuse::Kind::unexpected);
}

TEST_F(KnownGateTest, AnExpiredEntryExcusesNothing) {
  add_run("b", wrong_image_on(known_device));
  request_.expected_outcomes = rewritten_outcomes(gate("b"));
  request_.expected_outcomes->front().expiry = request_.today;
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

TEST_F(KnownGateTest, AFileWithAMistakeIsRejected) {
  const auto file = folder_.path() / "known.json";
  EXPECT_THROW((void)read_expected_outcomes(file), core::InputError);
  for (
      const char* entry :
      {R"({"device": "a", "test": "b", "reason": "c", "outcome": "fail"})",
       R"({"device": "a", "test": "b", "configuration": "*", "reason": "c"})",
       R"({"device": "a", "test": "b", "configuration": "*", "reason": " ", "outcome": "fail"})",
       R"({"device": "a", "test": "b", "configuration": "*", "reason": "c", "outcome": "red"})",
       R"({"device": "*", "test": "*", "configuration": "*", "reason": "c", "outcome": "fail"})"}) {
    core::write_file(std::string("[") + entry + "]", file);
    EXPECT_THROW((void)read_expected_outcomes(file), core::InputError) << entry;
  }
}

// Tests in which failed configurations are drawn again

TEST_F(KnownGateTest, AFailureThatDoesNotRepeatIsAFlakeAndDoesNotPass) {
  add_run("b", wrong_image_on(known_device));
  const GateResult first = gate("b");
  const CaseSet cases = failing_cases(first);
  ASSERT_THAT(cases, SizeIs(1));
  const SecondAttempt attempt = mark_flakes(first, gate("accepted"), cases);
  EXPECT_EQ(attempt.flakes, cases);
  EXPECT_EQ(attempt.result.exit_code(), ExitCode::regression);
  ASSERT_THAT(with(attempt.result, Verdict::regression), SizeIs(1));
  EXPECT_EQ(with(attempt.result, Verdict::regression).at(0).retry_result, RetryResult::flake);
  EXPECT_THAT(attempt.result.findings, SizeIs(first.findings.size()));

  const std::vector<Waiver> known = rewritten_outcomes(attempt.result);
  ASSERT_THAT(known, SizeIs(1));
  EXPECT_EQ(known[0].outcome, ExpectedOutcome::flake);
  request_.expected_outcomes = known;
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass);  // the flaky configuration fails this time
  // If a known flake passes, that does not count as an improvement.
  EXPECT_THAT(with(gate("accepted"), Verdict::improved), SizeIs(0));
}

// The verdict is neither a failure nor a pass, because a slow driver on a busy machine can also
// time out.
TEST_F(KnownGateTest, AHangThatDoesNotRepeatCannotBeJudged) {
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device != known_device || record.configuration != plain_) return;
    record.outcome = record::Outcome::hung;
    record.reason = {.cause = record::Cause::timeout, .numbers = {{"limit_s", 60}}};
  });
  const GateResult first = gate("b");
  EXPECT_EQ(first.exit_code(), ExitCode::regression);
  const SecondAttempt attempt = mark_flakes(first, gate("accepted"), failing_cases(first));
  EXPECT_TRUE(attempt.flakes.empty());
  EXPECT_EQ(attempt.result.exit_code(), ExitCode::cannot_judge);
  EXPECT_EQ(with(attempt.result, Verdict::cannot_judge).at(0).retry_result, RetryResult::slow);
  EXPECT_THAT(rewritten_outcomes(attempt.result), SizeIs(0));
}

// A crash is reported under the first check, which is `image` here. A configuration of
// speed_of_light, which only sums samples, has no image that could be judged. When it is drawn
// again without a crash, it therefore has no finding under the check `image`.
TEST_F(KnownGateTest, ACrashWithoutAnImageCanBeAFlake) {
  const auto sums = [](record::Record& record, core::Image&) {
    if (record.device != known_device || record.configuration != plain_) return;
    record.technique = "speed_of_light";
    if (record.run != "b") return;
    record.outcome = record::Outcome::crashed;
    record.reason = {.cause = record::Cause::signal, .numbers = {{"signal", 6}}};
  };
  add_run("b", sums);
  add_run("c", sums);
  const GateResult first = gate("b");
  const SecondAttempt attempt = mark_flakes(first, gate("c"), failing_cases(first));
  EXPECT_EQ(attempt.flakes, failing_cases(first));
  const auto flakes = with(attempt.result, Verdict::regression);
  ASSERT_THAT(flakes, SizeIs(1));
  EXPECT_EQ(flakes[0].retry_result, RetryResult::flake);
  EXPECT_EQ(flakes[0].reason.number("signal"), 6);
}

TEST_F(KnownGateTest, AFailureThatIsSkippedWhenRepeatedStaysARegression) {
  add_run("b", wrong_image_on(known_device));
  add_run("c", skipped_on(known_device));
  const GateResult first = gate("b");
  const SecondAttempt attempt = mark_flakes(first, gate("c"), failing_cases(first));
  EXPECT_TRUE(attempt.flakes.empty());
  const auto wrong = with(attempt.result, Verdict::regression);
  ASSERT_THAT(wrong, SizeIs(1));
  EXPECT_EQ(wrong[0].retry_result, RetryResult::other);
  ASSERT_THAT(wrong[0].retry_observations, SizeIs(1));
  EXPECT_EQ(wrong[0].retry_observations[0].reason.cause, record::Cause::not_supported);
}

// The counters fail both times, so only the image is flaky.
TEST_F(KnownGateTest, EachCheckCanBeAFlakeByItself) {
  request_.checks = {Check::image, Check::counters};
  const auto miscounted = [](record::Record& record, core::Image& image) {
    if (record.device != known_device || record.configuration != plain_) return;
    ++record.counters["samples"];
    if (record.run == "b") image.rgba[4 * 11] += 0.01F;
  };
  add_run("b", miscounted);
  add_run("c", miscounted);
  const GateResult first = gate("b");
  const SecondAttempt attempt = mark_flakes(first, gate("c"), failing_cases(first));
  EXPECT_THAT(attempt.flakes, SizeIs(1));
  const auto images = with(attempt.result, Verdict::regression, Check::image);
  ASSERT_THAT(images, SizeIs(1));
  EXPECT_EQ(images[0].retry_result, RetryResult::flake);
  const auto counters = with(attempt.result, Verdict::regression, Check::counters);
  ASSERT_THAT(counters, SizeIs(1));
  EXPECT_EQ(counters[0].retry_result, RetryResult::not_drawn);
}

TEST_F(KnownGateTest, ARepeatedFailureIsNotAFlake) {
  add_run("b", wrong_image_on(known_device));
  const GateResult first = gate("b");
  const SecondAttempt same = mark_flakes(first, gate("b"), failing_cases(first));
  EXPECT_TRUE(same.flakes.empty());
  EXPECT_EQ(text(same.result), text(first));
}

}  // namespace
}  // namespace triptych::judge
