#include "judge/gate/repeats.hpp"

#include <gtest/gtest.h>

namespace triptych::judge {
namespace {

const std::string device = "vulkan:some";

Finding finding(const std::string& configuration, Check check, Verdict verdict) {
  Finding result;
  result.device = device;
  result.configuration = configuration;
  result.check = check;
  result.verdict = verdict;
  result.cause = verdict == Verdict::pass ? Cause::within_bound : Cause::pixels_over_bound;
  return result;
}

// Returns one repetition of a plan. The image of configuration "a" has the given verdict, and the
// image of "b" is always wrong. All counters are correct.
Repetition repetition(Verdict verdict, const std::string& image) {
  GateResult result{.plan = "volume/quick", .run = "1", .findings = {}};
  result.findings = {finding("a", Check::image, verdict),
                     finding("a", Check::counters, Verdict::pass),
                     finding("b", Check::image, Verdict::regression),
                     finding("b", Check::counters, Verdict::pass)};
  return {.results = {result}, .images = {{{"volume/quick", device, "a"}, image}}};
}

const std::vector<Repetition>& three_repetitions() {
  static const std::vector<Repetition> repetitions{repetition(Verdict::pass, "1"),
                                                   repetition(Verdict::regression, "2"),
                                                   repetition(Verdict::pass, "1")};
  return repetitions;
}

TEST(Repeats, ContainTheWorstVerdictOfEachRepetition) {
  const std::vector<RepeatedCase> cases = repeated_cases(three_repetitions());
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[0].key.configuration, "a");
  EXPECT_EQ(cases[0].verdicts, (std::vector{Verdict::pass, Verdict::regression, Verdict::pass}));
  EXPECT_EQ(cases[0].images, 2U);
  EXPECT_TRUE(cases[0].is_flaky());
  EXPECT_EQ(cases[1].failures(), 3U);
  EXPECT_FALSE(cases[1].is_flaky()) << "a case that always fails is not a flake";
}

TEST(Repeats, AFlakeInALaterRepetitionIsReported) {
  std::vector<GateResult> first = three_repetitions().front().results;
  EXPECT_EQ(first.front().findings.front().verdict, Verdict::pass);
  add_flakes(repeated_cases(three_repetitions()), first);
  std::size_t flakes = 0;
  for (const Finding& each : first.front().findings) {
    if (each.retry_result != RetryResult::flake) continue;
    ++flakes;
    EXPECT_EQ(each.configuration, "a");
    EXPECT_EQ(each.verdict, Verdict::regression);
    EXPECT_EQ(each.check, Check::image);
  }
  EXPECT_EQ(flakes, 1U);
  EXPECT_EQ(first.front().findings.size(), 4U) << "the flake must replace the finding that passed";
}

}  // namespace
}  // namespace triptych::judge
