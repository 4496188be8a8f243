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
  [[nodiscard]] std::vector<Waiver> written_by(const GateResult& result) const {
    const auto file = folder_.path() / "known.json";
    core::write_file(
        expected_text(as_expected({&result, 1}, [](const Finding&) { return "words"; })), file);
    return read_expected(file);
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
  request_.known = written_by(first);
  ASSERT_THAT(*request_.known, SizeIs(1));
  const GateResult second = gate("b");
  EXPECT_EQ(second.exit_code(), ExitCode::pass) << text(second);
  ASSERT_THAT(with(second, Verdict::waived), SizeIs(1));
  EXPECT_EQ(with(second, Verdict::waived).at(0).excuse.of, Excuse::Of::known);
  // The next run writes the same file, because waived failures remain known.
  EXPECT_EQ(expected_text(written_by(second)), expected_text(*request_.known));
}

TEST_F(KnownGateTest, ANewFailureIsARegression) {
  request_.known.emplace();
  add_run("b", wrong_image_on(known_device));
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
  // Failures of other configurations, devices or checks are new.
  add_run("c", wrong_image_on("opencl:pocl"));
  request_.known = written_by(gate("c"));
  EXPECT_EQ(gate("c").exit_code(), ExitCode::pass);
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

TEST_F(KnownGateTest, AnUnexpectedPassIsReported) {
  add_run("b", wrong_image_on(known_device));
  request_.known = written_by(gate("b"));
  const GateResult mended = gate("accepted");
  EXPECT_EQ(mended.exit_code(), ExitCode::pass);
  ASSERT_THAT(with(mended, Verdict::improved), SizeIs(1));
  const Finding finding = with(mended, Verdict::improved).at(0);
  EXPECT_EQ(finding.excuse.of, Excuse::Of::unexpected);
  EXPECT_EQ(finding.excuse.known, Known::fail);
  EXPECT_EQ(finding.advice.advice, Advice::remove_entry);
}

TEST_F(KnownGateTest, AnUnexpectedSkipDoesNotPass) {
  add_run("b", skipped_on(known_device));
  AcceptRequest only_it;
  only_it.only = plain_;
  only_it.drop = true;
  (void)accept_run("b", only_it);
  ASSERT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  request_.known = written_by(gate("b"));
  ASSERT_THAT(*request_.known, SizeIs(1));
  EXPECT_EQ(request_.known->front().known, Known::skip);
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
  // If a configuration with a known skip is drawn, it counts as improved.
  EXPECT_THAT(with(gate("accepted"), Verdict::improved), SizeIs(1));
  request_.known->clear();
  EXPECT_EQ(gate("b").exit_code(), ExitCode::cannot_judge);
  EXPECT_EQ(with(gate("b"), Verdict::cannot_judge).at(0).excuse.of, Excuse::Of::unexpected);
}

TEST_F(KnownGateTest, AnExpiredEntryExcusesNothing) {
  add_run("b", wrong_image_on(known_device));
  request_.known = written_by(gate("b"));
  request_.known->front().expiry = request_.today;
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

TEST_F(KnownGateTest, AFileWithAMistakeIsRejected) {
  const auto file = folder_.path() / "known.json";
  EXPECT_THROW((void)read_expected(file), core::InputError);
  for (
      const char* entry :
      {R"({"device": "a", "test": "b", "reason": "c", "outcome": "fail"})",
       R"({"device": "a", "test": "b", "configuration": "*", "reason": "c"})",
       R"({"device": "a", "test": "b", "configuration": "*", "reason": " ", "outcome": "fail"})",
       R"({"device": "a", "test": "b", "configuration": "*", "reason": "c", "outcome": "red"})",
       R"({"device": "*", "test": "*", "configuration": "*", "reason": "c", "outcome": "fail"})"}) {
    core::write_file(std::string("[") + entry + "]", file);
    EXPECT_THROW((void)read_expected(file), core::InputError) << entry;
  }
}

// Tests in which failed configurations are drawn again

TEST_F(KnownGateTest, AFailureThatDoesNotRepeatIsAFlakeAndDoesNotPass) {
  add_run("b", wrong_image_on(known_device));
  const GateResult first = gate("b");
  const Places places = failing(first);
  ASSERT_THAT(places, SizeIs(1));
  const Redrawn right = tell_flakes(first, gate("accepted"), places);
  EXPECT_EQ(right.flakes, places);
  EXPECT_EQ(right.result.exit_code(), ExitCode::regression);
  ASSERT_THAT(with(right.result, Verdict::regression), SizeIs(1));
  EXPECT_EQ(with(right.result, Verdict::regression).at(0).drawn_again, Again::flake);
  EXPECT_THAT(right.result.findings, SizeIs(first.findings.size()));

  const std::vector<Waiver> known = written_by(right.result);
  ASSERT_THAT(known, SizeIs(1));
  EXPECT_EQ(known[0].known, Known::flake);
  request_.known = known;
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
  const Redrawn right = tell_flakes(first, gate("accepted"), failing(first));
  EXPECT_TRUE(right.flakes.empty());
  EXPECT_EQ(right.result.exit_code(), ExitCode::cannot_judge);
  EXPECT_EQ(with(right.result, Verdict::cannot_judge).at(0).drawn_again, Again::slow);
  EXPECT_THAT(written_by(right.result), SizeIs(0));
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
  const Redrawn right = tell_flakes(first, gate("c"), failing(first));
  EXPECT_EQ(right.flakes, failing(first));
  const auto flakes = with(right.result, Verdict::regression);
  ASSERT_THAT(flakes, SizeIs(1));
  EXPECT_EQ(flakes[0].drawn_again, Again::flake);
  EXPECT_EQ(flakes[0].reason.number("signal"), 6);
}

TEST_F(KnownGateTest, AFailureThatIsSkippedWhenRepeatedStaysARegression) {
  add_run("b", wrong_image_on(known_device));
  add_run("c", skipped_on(known_device));
  const GateResult first = gate("b");
  const Redrawn redrawn = tell_flakes(first, gate("c"), failing(first));
  EXPECT_TRUE(redrawn.flakes.empty());
  const auto wrong = with(redrawn.result, Verdict::regression);
  ASSERT_THAT(wrong, SizeIs(1));
  EXPECT_EQ(wrong[0].drawn_again, Again::other);
  ASSERT_THAT(wrong[0].again, SizeIs(1));
  EXPECT_EQ(wrong[0].again[0].reason.cause, record::Cause::not_supported);
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
  const Redrawn redrawn = tell_flakes(first, gate("c"), failing(first));
  EXPECT_THAT(redrawn.flakes, SizeIs(1));
  const auto images = with(redrawn.result, Verdict::regression, Check::image);
  ASSERT_THAT(images, SizeIs(1));
  EXPECT_EQ(images[0].drawn_again, Again::flake);
  const auto counters = with(redrawn.result, Verdict::regression, Check::counters);
  ASSERT_THAT(counters, SizeIs(1));
  EXPECT_EQ(counters[0].drawn_again, Again::not_drawn);
}

TEST_F(KnownGateTest, ARepeatedFailureIsNotAFlake) {
  add_run("b", wrong_image_on(known_device));
  const GateResult first = gate("b");
  const Redrawn same = tell_flakes(first, gate("b"), failing(first));
  EXPECT_TRUE(same.flakes.empty());
  EXPECT_EQ(text(same.result), text(first));
}

}  // namespace
}  // namespace triptych::judge
