// Compares the sentences that Triptych writes about findings, outcomes and advice with golden files
// (see golden.hpp).

#include "golden.hpp"

#include <fmt/format.h>

#include "findings.hpp"
#include "report/words/check.hpp"
#include "report/words/finding.hpp"
#include "report/words/outcome.hpp"

namespace triptych::report {
namespace {

// Returns an observation with every number and name that a sentence may contain.
judge::Observation everything(judge::Cause cause) {
  judge::Observation what = over_bound(16);
  what.cause = cause;
  const std::map<std::string, double> more{{"records", 12},
                                           {"wanted", 24},
                                           {"values", 6},
                                           {"configurations", 12},
                                           {"pixels_not_finite", 3},
                                           {"wrong_left", 5},
                                           {"wrong_top", 11},
                                           {"wrong_right", 41},
                                           {"wrong_bottom", 55},
                                           {"pixels_of_another_particle", 4},
                                           {"pixels_at_another_depth", 5},
                                           {"particle", 17},
                                           {"depth", 0.5},
                                           {"expected_depth", 0.25},
                                           {"depth_bound", 0.001},
                                           {"width", 64},
                                           {"height", 48},
                                           {"expected_width", 128},
                                           {"expected_height", 96},
                                           {"other_width", 96},
                                           {"other_height", 72},
                                           {"rms", 0.0002},
                                           {"allowed", 0.0001},
                                           {"rmse_of_other", 0.01},
                                           {"stored", 12},
                                           {"compared", 8},
                                           {"differences", 2},
                                           {"median_ratio", 1.1},
                                           {"median_ns", 2.5e6},
                                           {"baseline_ns", 2e6},
                                           {"ratio", 1.25},
                                           {"half_width", 0.02},
                                           {"work_ratio", 1.2},
                                           {"worst_ratio", 2},
                                           {"worst_half_width", 0.03},
                                           {"least_ratio", 1.2},
                                           {"largest_ratio", 1.3},
                                           {"intercept", 0.7},
                                           {"slope", 1.4},
                                           {"scale", 0.01},
                                           {"rho", 0.99},
                                           {"pearson", 0.98},
                                           {"standard_error", 0.01},
                                           {"q", 0.001},
                                           {"order", 1.95},
                                           {"stored_order", 2},
                                           {"stored_half_width", 0.01},
                                           {"score", 1},
                                           {"best", 3},
                                           {"accepted", 3},
                                           {"pixels_differing", 2},
                                           {"channel", 1},
                                           {"value", 0.3},
                                           {"expected_value", 0.25},
                                           {"count", 1000033},
                                           {"factor", 20834},
                                           {"unit", 48}};
  what.numbers.insert(more.begin(), more.end());
  what.changes = {{.name = "samples", .before = 1000, .now = 1100}};
  what.names = {"step=1", "step=2"};
  what.facts = {{"run", "20260201-1"},
                {"plan", "volume/quick"},
                {"glob", "gl:*"},
                {"kind", "planned"},
                {"hash", "0a0a"},
                {"now", "1b1b"},
                {"accepted", "2c2c"},
                {"folder", "baselines/volume/quick"},
                {"test", "volume.quick.image.gl:x"},
                {"device", "gl:x"},
                {"expiry", "2027-01-01"},
                {"other", "opencl:pocl"},
                {"driver_version", "23.0"},
                {"other_version", "22.3.6"},
                {"counted_by", "valgrind 3.19"},
                {"configuration", "step=1"},
                {"work", "samples"},
                {"refusal", "slope_out_of_range"},
                {"levels", "skip=bricks"},
                {"counter", "samples"},
                {"of", "rays"},
                {"sibling", "opencl:pocl"},
                {"what", "vulkan"},
                {"by", "bits"}};
  what.detail = "DETAIL";
  what.outcome = record::Outcome::crashed;
  what.reason = {.cause = record::Cause::signal, .numbers = {{"signal", 11}}};
  if (cause == judge::Cause::device_fault) what.facts["kind"] = "clock_reads_zero";
  if (cause == judge::Cause::wrong_image || cause == judge::Cause::reference_changed ||
      cause == judge::Cause::score) {
    what.because = {over_bound(16)};
  }
  return what;
}

TEST(Sentences, OfEveryCause) {
  std::string text;
  for_each_value<judge::Cause>([&](judge::Cause cause) {
    const std::string sentence = words::text_of(everything(cause));
    if (cause != judge::Cause::none) {
      EXPECT_NE(sentence, "") << judge::name_of(cause);
    }
    text += fmt::format("{}: {}\n", judge::name_of(cause), sentence);
  });
  expect_golden("causes.txt", text);
}

TEST(Sentences, OfEveryOutcome) {
  std::string text;
  for_each_value<record::Cause>([&](record::Cause cause) {
    record::Reason reason{.cause = cause,
                          .numbers = {{"signal", 11},
                                      {"exit_code", 3},
                                      {"limit_s", 60},
                                      {"limit_bytes", 512 << 20},
                                      {"times", 2}},
                          .subject = "vkQueueSubmit",
                          .code = "ErrorDeviceLost",
                          .detail = "DETAIL",
                          .last_output = ""};
    text += fmt::format("{}: {}\n", record::name_of(cause), words::text_of(reason));
  });
  record::Reason reason{.cause = record::Cause::timeout,
                        .stage = record::Stage::opening,
                        .numbers = {{"limit_s", 1.5}},
                        .subject = "gl:x",
                        .not_tried = true,
                        .shared_levels = "technique=raycast",
                        .last_output = "cannot map"};
  text += words::text_of(record::Outcome::hung, reason) + "\n";
  reason.stage = record::Stage::counting;
  text += words::text_of(record::Outcome::skipped, reason) + "\n";
  expect_golden("outcomes.txt", text);
}

TEST(Sentences, OfEveryAdvice) {
  std::string text;
  for_each_value<judge::Advice>([&](judge::Advice advice) {
    judge::Finding finding;
    finding.advice = {advice, "triptych COMMAND"};
    text += fmt::format("{}: {}\n", judge::name_of(advice), words::advice(finding));
  });
  expect_golden("advice.txt", text);
}

TEST(Sentences, OfEveryWorth) {
  std::string text;
  for_each_value<record::Worth>([&](record::Worth worth) {
    text += fmt::format("{}: {}\n", record::name_of(worth),
                        words::text_of({.worth = worth,
                                        .low = 1.25,
                                        .high = 3.5,
                                        .counter = "fragments_kept",
                                        .detail = "DETAIL"}));
  });
  expect_golden("worths.txt", text);
}

TEST(Sentences, OfExcusesAndRepetitions) {
  judge::Finding finding =
      finding_of(judge::Check::image, judge::Verdict::waived, "gl:x", "step=1", over_bound(16));
  std::string text;
  for_each_value<judge::Excuse::Kind>([&](judge::Excuse::Kind kind) {
    finding.excuse = {.kind = kind, .reason = "REASON", .expiry = "2027-01-01"};
    text += fmt::format("{}: {}\n", judge::name_of(kind), words::found(finding));
  });
  finding.excuse = {};
  finding.retry_observations = {crashed(11)};
  for_each_value<judge::RetryResult>([&](judge::RetryResult result) {
    finding.retry_result = result;
    text += fmt::format("{}: {}\n", judge::name_of(result), words::found(finding));
  });
  expect_golden("excuses.txt", text);
}

// A check without a row would be shown without a name on screens and pages.
TEST(CheckWords, EveryCheckHasARow) {
  record::Checks checks;
  for (const words::CheckWords& row : words::check_words) checks.insert(row.check);
  EXPECT_EQ(checks, record::every_check());
}

}  // namespace
}  // namespace triptych::report
