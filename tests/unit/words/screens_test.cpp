// Checks the final screens that users see: for a pass, for each kind of failure, and for a run that
// could not be judged.

#include "findings.hpp"
#include "golden.hpp"
#include "report/screen/summary_screen.hpp"

namespace triptych::report {
namespace {

using judge::Advice;
using judge::Cause;
using judge::Check;
using enum judge::Verdict;

const std::string lavapipe = "vulkan:lavapipe";

// Returns the findings of two devices, each with two techniques of six configurations. Only raycast
// on lavapipe has the finding `what`; all other configurations pass.
judge::GateResult result_with(Check check, judge::Verdict verdict, const judge::Observation& what,
                              const judge::AdviceWithCommand& advice = {}) {
  judge::GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  for (const char* technique : {"raycast", "slices"}) {
    for (int step = 1; step <= 6; ++step) {
      const std::string configuration = fmt::format("step={},technique={}", step, technique);
      const bool wrong = std::string_view(technique) == "raycast";
      result.findings.push_back(finding_of(check, wrong ? verdict : pass, lavapipe, configuration,
                                           wrong ? what : within_bound()));
      if (wrong) result.findings.back().advice = advice;
      result.findings.push_back(
          finding_of(check, pass, "opencl:pocl", configuration, within_bound()));
    }
  }
  result.devices = {lavapipe, "opencl:pocl"};
  return result;
}

void expect_screen(const std::string& name, const judge::GateResult& result) {
  expect_golden(name + ".txt",
                summary_screen(std::vector{result}, 88, std::vector<std::string>{"out/report.html"},
                               {.width = 80}));
}

TEST(Screens, Pass) {
  expect_screen("pass", result_with(Check::image, pass, within_bound()));
}

TEST(Screens, WrongImage) {
  expect_screen("wrong_image", result_with(Check::image, regression, over_bound(11139)));
}

TEST(Screens, Crash) {
  judge::Observation what = crashed(11);
  what.reason.last_output = "LLVM ERROR: out of memory";
  expect_screen("crash", result_with(Check::image, regression, what));
}

TEST(Screens, Timeout) {
  expect_screen("timeout",
                result_with(Check::image, regression,
                            ended(record::Outcome::hung, {.cause = record::Cause::timeout,
                                                          .numbers = {{"limit_s", 20}}})));
}

TEST(Screens, Counters) {
  expect_screen("counters", result_with(Check::counters, regression, changed("samples")));
}

TEST(Screens, Cost) {
  expect_screen("cost",
                result_with(Check::cost, regression,
                            {.cause = Cause::values_changed,
                             .against = judge::Against::baseline,
                             .numbers = {{"instructions", 2100}, {"stored_instructions", 2000}},
                             .changes = {{.name = "device_code",
                                          .unit = judge::Unit::instructions,
                                          .before = 1000,
                                          .now = 1100}}}));
}

TEST(Screens, NothingStored) {
  expect_screen("nothing_stored",
                result_with(Check::counters, cannot_judge,
                            {.cause = Cause::not_stored, .names = {"step=1", "step=2"}},
                            {Advice::accept, "triptych accept volume/quick --reason TEXT"}));
}

TEST(Screens, InvalidInput) {
  expect_screen(
      "invalid_input",
      result_with(Check::image, cannot_judge,
                  ended(record::Outcome::skipped,
                        {.cause = record::Cause::bad_input,
                         .detail = "head.nrrd:3: spacing 0, expected a number above 0"})));
}

TEST(Screens, Waived) {
  judge::GateResult result = result_with(Check::image, waived, over_bound(11139));
  for (judge::Finding& each : result.findings) {
    if (each.verdict != waived) continue;
    each.excuse = {.kind = judge::Excuse::Kind::waived,
                   .reason = "driver bug, reported upstream",
                   .expiry = "2027-01-01"};
  }
  expect_screen("waived", result);
}

}  // namespace
}  // namespace triptych::report
