#include "report/screen/summary_screen.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "findings.hpp"
#include "report/ci/markdown.hpp"
#include "report/overview.hpp"
#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::GateResult;
using testing::HasSubstr;
using testing::Not;
using enum judge::Verdict;

void add(GateResult& result, Check check, judge::Verdict verdict, const std::string& device,
         const std::string& configuration, const judge::Observation& what = {}) {
  result.findings.push_back(finding_of(check, verdict, device, configuration, what));
  result.devices.insert(device);
}

GateResult failing() {
  GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  for (const char* technique : {"raycast", "slices"}) {
    for (int step = 1; step <= 6; ++step) {
      const bool wrong = std::string_view(technique) == "raycast";
      const std::string configuration = fmt::format("step={},technique={}", step, technique);
      add(result, Check::image, wrong ? regression : pass, "vulkan:lavapipe", configuration,
          wrong ? over_bound(11138 + step) : within_bound());
      add(result, Check::image, pass, "opencl:pocl", configuration, within_bound());
      add(result, Check::counters, pass, "opencl:pocl", configuration);
      add(result, Check::timing, advisory, "opencl:pocl", configuration);
    }
  }
  return result;
}

GateResult passing() {
  GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  add(result, Check::image, pass, "gl:x", "step=1", within_bound());
  return result;
}

TEST(SummaryScreen, OfAPassIsShort) {
  GateResult result = passing();
  const std::string text = summary_screen(std::vector{result}, 3, {});
  EXPECT_THAT(text, HasSubstr("PASS (0)"));
  EXPECT_LE(std::ranges::count(text, '\n'), 10);
}

// If no image comes close to its bound, the bound is a weak test, and the screen must show that.
TEST(SummaryScreen, ShowsHowCloseImagesAreToTheirBounds) {
  GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  for (const auto& [device, ratio] :
       {std::pair("gl:x", 0.61), {"gl:x", 0.2}, {"opencl:y", 0.003}}) {
    add(result, Check::image, pass, device, fmt::format("step={}", ratio), within_bound());
    result.findings.back().numbers["ratio"] = ratio;
  }
  add(result, Check::image, pass, "", "", {.cause = judge::Cause::reference_as_stored});
  result.findings.back().numbers["ratio"] = 7;  // without a device, so it is not shown
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}, {.width = 120}),
              HasSubstr("3 within their error bounds; error / bound ≤ 0.61 (≤ 0.003 on opencl:y in "
                        "volume/quick)\n"));
  const auto all = overview(std::vector{result});
  ASSERT_EQ(all.bounds.size(), 2U);
  EXPECT_EQ(all.bounds[0].device, "gl:x");
  EXPECT_EQ(all.bounds[0].images, 2U);
  EXPECT_EQ(all.bounds[0].configuration, "step=0.61");
  EXPECT_EQ(all.bounds[1].share, 0.003);
}

// A waived finding must not be counted as an image within its bound.
TEST(SummaryScreen, ListsWaivedFindings) {
  GateResult result = passing();
  result.findings.back().numbers["ratio"] = 0.5;
  add(result, Check::image, waived, "gl:x", "step=2", over_bound(3));
  result.findings.back().excuse = {
      .kind = judge::Excuse::Kind::waived, .reason = "known", .expiry = "2027-01-01"};
  result.findings.back().numbers["ratio"] = 4e5;
  const std::string text = summary_screen(std::vector{result}, 3, {});
  EXPECT_THAT(text, HasSubstr("1 within their error bounds; 1 waived; error / bound ≤ 0.5\n"));
  EXPECT_THAT(text, HasSubstr("\n  – waived until 2027-01-01 (known): gl:x, step=2: 3 of"));
}

// These circumstances may make a pass worthless.
TEST(SummaryScreen, ListsTheCircumstancesOfAPass) {
  GateResult result = passing();
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}), Not(HasSubstr("  ! ")));
  result.injected = {{"slowdown:20", 4}};
  result.measured_by = "build a; judged by build b";
  result.old_run_date = "2026-02-01";
  result.unusable = {{"Vulkan", "no loader", {}}};
  const std::string text = summary_screen(std::vector{result}, 3, {}, {.width = 120});
  EXPECT_THAT(text, HasSubstr("PASS (0)"));
  EXPECT_THAT(text, HasSubstr("4 records have injected faults (slowdown:20)"));
  EXPECT_THAT(text, HasSubstr("another build of Triptych: build a; judged by build b"));
  EXPECT_THAT(text, HasSubstr("the measurements are from 2026-02-01"));
  EXPECT_THAT(text, HasSubstr("unusable on this machine: Vulkan: no loader"));
}

TEST(SummaryScreen, SuggestsToExcuseMissingDataUnlessTheyAreExcused) {
  GateResult result = passing();
  record::Reason no_file{.cause = record::Cause::not_supported};
  no_file.subject = "tooth.nrrd";
  add(result, Check::image, skipped, "gl:x", "step=2", ended(record::Outcome::skipped, no_file));
  const auto screen = [&] { return summary_screen(std::vector{result}, 3, {}, {.width = 120}); };
  EXPECT_THAT(screen(), HasSubstr("missing data files: 1 (tooth.nrrd)"));
  EXPECT_THAT(screen(), HasSubstr("--without-data"));
  result.data_excused = true;
  EXPECT_THAT(screen(), HasSubstr("missing data files: 1 (tooth.nrrd)"));
  EXPECT_THAT(screen(), Not(HasSubstr("--without-data")));
}

TEST(SummaryScreen, ListsTheDriversAndThoseThatWereNeverAccepted) {
  GateResult result = passing();
  result.tested = {
      {"gl:x", {"x", "Mesa 1"}}, {"vulkan:x", {"x", "Mesa 1"}}, {"opencl:y", {"y", "3", false}}};
  const std::string text = summary_screen(std::vector{result}, 3, {}, {.width = 120});
  EXPECT_THAT(text, HasSubstr("\n  x Mesa 1: gl:x, vulkan:x\n  y 3: opencl:y\n"));
  EXPECT_THAT(text, HasSubstr("not among the accepted ones: y 3 (opencl:y)\n"));
  EXPECT_THAT(markdown(result), HasSubstr("x Mesa 1: gl:x, vulkan:x; y 3: opencl:y"));
  for (int i = 0; i < 9; ++i) result.tested[fmt::format("gl:{}", i)] = {"z", fmt::to_string(i)};
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}),
              HasSubstr("\n  9 more driver versions\n"));
}

// A plan of the same command may have accepted the driver.
TEST(SummaryScreen, NamesThePlansForWhichADriverWasNotAccepted) {
  GateResult known = passing();
  known.tested = {{"gl:x", {"x", "1"}}};
  GateResult unknown = passing();
  unknown.plan = "volume/stress";
  unknown.tested = {{"gl:x", {"x", "1", false}}};
  EXPECT_THAT(summary_screen(std::vector{known, unknown}, 3, {}, {.width = 120}),
              HasSubstr("x 1 in volume/stress (gl:x)\n"));
}

TEST(SummaryScreen, NamesBaselinesOutsideTheWorkingDirectory) {
  GateResult result = passing();
  result.other_baselines = "/usr/share/b";
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}, {.width = 120}),
              HasSubstr("! compared with the baselines in /usr/share/b\n"));
  result.lacks_own_baselines = true;
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}, {.width = 120}),
              HasSubstr("in /usr/share/b, because the working directory has no folder"));
}

TEST(SummaryScreen, ListsWaiversWithoutEffect) {
  GateResult result = passing();
  add(result, Check::image, advisory, "", "",
      {.cause = judge::Cause::unused_waiver,
       .facts = {{"test", "volume.quick.image.*"}, {"device", "gl:*"}, {"configuration", "*"}},
       .detail = "known"});
  result.devices = {"gl:x"};
  // The same waiver is reported for each plan.
  const std::string text = summary_screen(std::vector{result, result}, 3, {}, {.width = 120});
  EXPECT_THAT(text, HasSubstr("! the waiver for volume.quick.image.* on gl:* excuses nothing"));
  EXPECT_EQ(text.find("excuses nothing"), text.rfind("excuses nothing"));
}

TEST(SummaryScreen, NamesChecksWithoutAVerdict) {
  GateResult result = passing();
  result.checks = {Check::image, Check::statistics};
  add(result, Check::statistics, advisory, "gl:x", "");
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}, {.width = 120}),
              HasSubstr("exit 0: every check that reached a verdict passed; no verdict: "
                        "statistics\n"));
  add(result, Check::statistics, pass, "gl:y", "step=1");
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}, {.width = 120}),
              HasSubstr("; no verdict: statistics on gl:x\n"));
  add(result, Check::statistics, pass, "gl:x", "step=1");
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}),
              HasSubstr("exit 0: every requested check passed\n"));
}

// A device of one plan does not decide for the same device in another plan.
TEST(SummaryScreen, NamesTheDevicesOfAPlanWithoutAVerdict) {
  GateResult decided = passing();
  decided.checks = {Check::image};
  GateResult undecided = passing();
  undecided.checks = {Check::image, Check::memory};
  add(decided, Check::memory, pass, "gl:x", "step=1");
  decided.checks.insert(Check::memory);
  add(undecided, Check::memory, skipped, "gl:x", "step=1");
  EXPECT_THAT(summary_screen(std::vector{decided, undecided}, 3, {}, {.width = 120}),
              HasSubstr("; no verdict: memory on gl:x\n"));
}

TEST(SummaryScreen, StatesWhetherTimesDecided) {
  GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  add(result, Check::timing, pass, "gl:x", "step=1", {.cause = judge::Cause::time});
  add(result, Check::timing, advisory, "gl:x", "", {.cause = judge::Cause::times});
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}),
              HasSubstr("  Times       –          1 shown, not judged; 1 with an advisory\n"));
  result.times_decided = true;
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}),
              HasSubstr("  Times       pass       1 not slower; 1 with an advisory\n"));
}

TEST(SummaryScreen, StatesThatOnlyAPartWasJudged) {
  GateResult result = passing();
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}), Not(HasSubstr("a part")));
  result.part = true;
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}),
              HasSubstr("Triptych   1 device · 3 s · only part of the plans"));
}

TEST(SummaryScreen, WithoutAVerdictShowsWhatIsCorrect) {
  GateResult result = passing();
  add(result, Check::image, cannot_judge, "", "", {.cause = judge::Cause::no_required_device});
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}),
              HasSubstr("the plan: 1 of 1 checks not judged; 1 within their error bounds"));
}

TEST(SummaryScreen, OfNoFindingsDoesNotPass) {
  EXPECT_THAT(summary_screen({}, 0, {}), HasSubstr("CANNOT JUDGE (2)"));
}

TEST(SummaryScreen, ShowsTheWorstVerdictOfAllPlans) {
  GateResult good{.plan = "particles/quick", .run = "r", .findings = {}};
  add(good, Check::image, pass, "gl:x", "step=1", within_bound());
  const std::string text = summary_screen(std::vector{good, failing(), good}, 3, {});
  EXPECT_THAT(text, HasSubstr("FAIL (1)"));
  EXPECT_THAT(text, HasSubstr("3 devices"));
}

TEST(SummaryScreen, HasAtMostFortyLinesAndReportsOmissions) {
  GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  for (int i = 0; i < 60; ++i) {
    add(result, Check::image, regression, fmt::format("gl:x#{}", i), "step=1", over_bound(1));
  }
  const std::string text =
      summary_screen(std::vector{result}, 3, std::vector<std::string>{"page"}, {.width = 120});
  EXPECT_LE(std::ranges::count(text, '\n'), 40);
  EXPECT_THAT(text, HasSubstr("more causes"));
  EXPECT_THAT(text, HasSubstr("; 57 more devices"));
}

TEST(SummaryScreen, RefersToTheOtherCausesAndAdvice) {
  GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  for (int i = 0; i < 60; ++i) {
    add(result, Check::image, cannot_judge, fmt::format("gl:x#{}", i), "step=1",
        quoting(std::string(400, 'x')));
    result.findings.back().advice = {judge::Advice::accept, "triptych accept PLAN"};
  }
  const std::string text = summary_screen(std::vector{result}, 3, {}, {.width = 120});
  EXPECT_THAT(text, HasSubstr("more causes: use --out FOLDER to write them to files"));
  EXPECT_THAT(text, HasSubstr("accept the run with triptych accept PLAN"));
}

TEST(SummaryScreen, ColoursOnlyWhenAsked) {
  const std::vector<GateResult> results{failing()};
  EXPECT_EQ(summary_screen(results, 3, {}).find('\x1b'), std::string::npos);
  EXPECT_THAT(summary_screen(results, 3, {}, {.colours = true}), HasSubstr("\x1b[1;31mFAIL"));
}

TEST(SummaryScreen, EscapesNames) {
  for (const std::string& name : test::hostile_strings()) {
    GateResult result{.plan = name, .run = "r", .findings = {}};
    add(result, Check::image, regression, name, "step=" + name, quoting(name));
    add(result, Check::image, regression, "", "", quoting(name));
    const std::string text = summary_screen(std::vector{result}, 3, std::vector{name});
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_THAT(text, Not(HasSubstr("line\nend")));
    EXPECT_LE(std::ranges::count(text, '\n'), 40);
    EXPECT_LT(text.size(), 4000U);
  }
}

TEST(SummaryScreen, RepeatsTheEnvironment) {
  GateResult result = failing();
  result.environments = {{"vulkan:lavapipe", {{"LP_NUM_THREADS", "2"}}}};
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}),
              HasSubstr("LP_NUM_THREADS=2 triptych render"));
}

// Accepting a baseline cannot correct an image, so the screen proposes it only for changed values.
TEST(SummaryScreen, SuggestsTheNextStep) {
  const std::string wrong = summary_screen(std::vector{failing()}, 3, {});
  EXPECT_THAT(wrong,
              HasSubstr("next: for a bug report, replace `render` by `reduce` in the command"));
  EXPECT_THAT(wrong, Not(HasSubstr("triptych accept")));
  GateResult counted{.plan = "volume/quick", .run = "r", .findings = {}};
  add(counted, Check::counters, regression, "gl:x", "step=1", changed("samples"));
  EXPECT_THAT(summary_screen(std::vector{counted}, 3, {}, {.store_option = " --store s.sqlite"}),
              HasSubstr("triptych accept volume/quick --store s.sqlite --reason TEXT\n"));
  EXPECT_THAT(summary_screen(std::vector{passing()}, 3, {}), Not(HasSubstr("next:")));
}

// A lower score, or a changed counter next to a wrong image, is a fault, not an intended change.
TEST(SummaryScreen, DoesNotSuggestToAcceptWrongFramesOrInjectedFaults) {
  GateResult both{.plan = "volume/quick", .run = "r", .findings = {}};
  add(both, Check::counters, regression, "gl:x", "step=1", changed("samples"));
  const std::vector<judge::Observation> faults{over_bound(3), crashed(11)};
  for (const judge::Observation& fault : faults) {
    GateResult wrong = both;
    add(wrong, Check::image, regression, "gl:x", "step=2", fault);
    const std::string text = summary_screen(std::vector{wrong}, 3, {});
    EXPECT_THAT(text, HasSubstr("next: for a bug report, replace `render` by `reduce`"));
    EXPECT_THAT(text, Not(HasSubstr("triptych accept")));
  }
  GateResult stress = both;
  add(stress, Check::stress, regression, "gl:x", "step=2",
      {.cause = judge::Cause::score, .against = judge::Against::baseline});
  EXPECT_THAT(summary_screen(std::vector{stress}, 3, {}), Not(HasSubstr("triptych accept")));
  both.injected = {{"slowdown:20", 4}};
  const std::string text = summary_screen(std::vector{both}, 3, {});
  EXPECT_THAT(text, HasSubstr("next: to test the driver, measure again without --inject\n"));
  EXPECT_THAT(text, Not(HasSubstr("triptych accept")));
  EXPECT_THAT(text, Not(HasSubstr("waivers.json")));
}

TEST(SummaryScreen, NamesTheFileForWaivers) {
  GateResult result = failing();
  result.waivers_file = "own/waivers.json";
  EXPECT_THAT(summary_screen(std::vector{result}, 3, {}),
              HasSubstr("to excuse a known bug: own/waivers.json (docs/validate.md)\n"));
}

// Everything that may be above and below the causes is shown at its longest.
TEST(SummaryScreen, HasAtMostFortyLinesWithEveryKindOfNote) {
  GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  for (const Check check : record::every_check()) {
    for (int i = 0; i < 5; ++i) {
      add(result, check, regression, fmt::format("gl:{}", i), "step=1", changed("samples"));
    }
  }
  for (int i = 0; i < 9; ++i) {
    add(result, Check::image, waived, fmt::format("vulkan:{}", i), "step=1", over_bound(1));
    result.unusable.push_back(
        {fmt::format("Vulkan {}", i), std::string(300, static_cast<char>('a' + i)), {}});
    result.tested[fmt::format("gl:{}", i)] = {"driver", fmt::to_string(i)};
  }
  const std::string text = summary_screen(std::vector{result}, 3, std::vector<std::string>{"page"});
  EXPECT_LE(std::ranges::count(text, '\n'), 40) << text;
}

// A single driver bug typically affects every plan.
TEST(SummaryScreen, OneCauseInSeveralPlansIsReportedOnce) {
  GateResult stress{.plan = "volume/stress", .run = "r", .findings = {}};
  add(stress, Check::image, regression, "vulkan:lavapipe", "technique=raycast", over_bound(3));
  const std::string text = summary_screen(std::vector{failing(), stress}, 3, {});
  EXPECT_THAT(text, HasSubstr("vulkan:lavapipe (7 configurations)"));
  // The screen describes the worst configuration, but its command reproduces the smallest.
  EXPECT_THAT(text, HasSubstr("image on vulkan:lavapipe: 11144 of 36864 pixels"));
  EXPECT_THAT(text, HasSubstr("worst in raycast.s6: 11144 of 36864 pixels"));
  EXPECT_THAT(text, Not(HasSubstr("3 of 36864 pixels")));
  EXPECT_THAT(text, HasSubstr("reproduce the smallest configuration, raycast:"));
  EXPECT_THAT(text, Not(HasSubstr("--set step")));
  EXPECT_EQ(text.find("✗", text.find("\n\n")), text.rfind("✗"));

  stress.findings.front().configuration = "technique=slices";
  EXPECT_THAT(summary_screen(std::vector{failing(), stress}, 3, {}), HasSubstr("technique=slices"))
      << "another technique may fail for another cause";
}

TEST(SummaryScreen, CrashesAreOneCauseInAllPlans) {
  std::vector<GateResult> results;
  for (const char* plan : {"volume/quick", "volume/stress", "particles/quick"}) {
    results.push_back({.plan = plan, .run = "r", .findings = {}});
    add(results.back(), Check::image, regression, "gl:x", fmt::format("technique={}", plan),
        ended(record::Outcome::failed,
              {.cause = record::Cause::error, .detail = "no OpenGL 3.3 core context"}));
  }
  const std::string text = summary_screen(results, 3, {});
  EXPECT_THAT(text, HasSubstr("✗ image: gl:x (3 configurations)"));
  EXPECT_EQ(text.find("no OpenGL", text.find("\n\n")), text.rfind("no OpenGL"));
}

TEST(SummaryScreen, UnmeasuredPlansAreOneCause) {
  std::vector<GateResult> results;
  for (const char* plan : {"volume/quick", "volume/stress", "particles/quick"}) {
    results.push_back({.plan = plan, .run = "", .findings = {}});
    add(results.back(), Check::image, cannot_judge, "", "", {.cause = judge::Cause::no_run});
  }
  EXPECT_THAT(summary_screen(results, 3, {}), HasSubstr("? image: volume/quick and 2 more"));
}

}  // namespace
}  // namespace triptych::report
