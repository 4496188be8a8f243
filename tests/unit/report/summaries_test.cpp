#include <fmt/format.h>
#include <gmock/gmock.h>

#include "findings.hpp"
#include "report/ci/folder.hpp"
#include "report/ci/junit.hpp"
#include "report/ci/markdown.hpp"
#include "support/temporary_folder.hpp"
#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using testing::HasSubstr;
using testing::Not;

judge::GateResult some_result() {
  judge::GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  result.findings.push_back(finding_of(judge::Check::image, judge::Verdict::regression, "gl:x",
                                       "step=1", quoting("3 < 4 | pixels")));
  result.findings.back().numbers = {{"max_error", 0.5}};
  for (int i = 0; i < 12; ++i) {
    result.findings.push_back(finding_of(judge::Check::timing, judge::Verdict::advisory, "gl:x",
                                         fmt::format("step={}", i),
                                         {.cause = judge::Cause::times}));
  }
  return result;
}

TEST(Markdown, ShowsHowCloseImagesAreToTheirBounds) {
  judge::GateResult result = some_result();
  result.findings.front().numbers["ratio"] = 7;  // of a wrong image, so it is not shown
  result.findings.push_back(result.findings.front());
  result.findings.back().verdict = judge::Verdict::pass;
  result.findings.back().numbers["ratio"] = 0.25;
  EXPECT_THAT(markdown(result), HasSubstr("| volume/quick | gl:x | 1 | 0.25 | step=1 |"));
  EXPECT_THAT(markdown(some_result()), Not(HasSubstr("largest error / bound")));
}

// The log uses the same short names as the screen, and the long key only once for each finding.
TEST(GateLog, NamesConfigurationsLikeTheScreen) {
  judge::GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  for (const char* step : {"1", "2"}) {
    result.findings.push_back(finding_of(judge::Check::image, judge::Verdict::regression, "gl:x",
                                         fmt::format("data=generate:ball:8,step={}", step),
                                         over_bound(3)));
  }
  const test::TemporaryFolder folder;
  static_cast<void>(write_folder(folder.path(), {&result, 1}, {}));
  const std::string log = folder.read("gate.log");
  EXPECT_THAT(log, HasSubstr("\n             ball_8.s2\n"));
  EXPECT_THAT(log, HasSubstr("key of ball_8.s1: data=generate:ball:8,step=1\n"));
  EXPECT_THAT(log, Not(HasSubstr("data=generate:ball:8,step=2")));
}

TEST(Junit, CountsFailuresAndEscapes) {
  const std::string xml = junit(some_result());
  EXPECT_NE(xml.find("<testsuite name=\"volume/quick.image\" tests=\"1\" failures=\"1\" "
                     "errors=\"0\" skipped=\"0\">"),
            std::string::npos)
      << xml;
  EXPECT_NE(xml.find("skipped=\"12\""), std::string::npos);
  EXPECT_NE(xml.find("<property name=\"max_error\" value=\"0.5\"/>"), std::string::npos);
  EXPECT_NE(xml.find("<property name=\"cause\" value=\"no_reference\"/>"), std::string::npos);
}

TEST(Junit, ContainsEveryPlan) {
  judge::GateResult other = some_result();
  other.plan = "volume/stress";
  const std::string xml = junit(std::vector{some_result(), other});
  EXPECT_NE(xml.find("volume/quick.image"), std::string::npos);
  EXPECT_NE(xml.find("volume/stress.image"), std::string::npos);
  EXPECT_EQ(test::xml_fault(xml), "");
}

TEST(Junit, IsUtf8WhateverADriverPrints) {
  judge::GateResult result = some_result();
  result.findings.front().detail = "GL_RENDERER \xff";
  EXPECT_EQ(junit(result).find('\xff'), std::string::npos);
}

TEST(Junit, ContainsCommandsToReproduce) {
  const std::string xml = junit(some_result());
  EXPECT_NE(
      xml.find("3 &lt; 4 | pixels\n"
               "triptych render volume --device gl:x --set step=1 --truth --out repro</failure>"),
      std::string::npos)
      << xml;
}

judge::GateResult hostile(const std::string& name) {
  judge::GateResult result = some_result();
  result.plan = name;
  judge::Finding& finding = result.findings.front();
  finding.detail = finding.device = finding.test = name;
  finding.configuration = "step=" + name;
  finding.numbers = {{name, 1}};
  return result;
}

TEST(Junit, IsWellFormedForAnyInput) {
  for (const std::string& name : test::hostile_strings()) {
    EXPECT_EQ(test::xml_fault(junit(hostile(name))), "");
  }
}

TEST(Markdown, HasTheRowsAndCausesOfTheSummaryScreen) {
  const std::string text = markdown(some_result());
  EXPECT_TRUE(text.starts_with("## FAIL (1): volume/quick\n")) << text;
  EXPECT_THAT(text, HasSubstr("| Images | **FAIL** | gl:x: 1 of 1 checks wrong |"));
  EXPECT_THAT(text, HasSubstr("3 &lt; 4 \\| pixels"));
  EXPECT_THAT(text, HasSubstr("```sh\n  triptych render volume --device gl:x"));
  EXPECT_THAT(
      text,
      HasSubstr("report.html also contains 1 remark that does not affect the verdict: timing 1"));
}

TEST(Markdown, ListsWaivedAndImprovedFindings) {
  judge::GateResult result = some_result();
  result.findings.push_back(finding_of(judge::Check::cost, judge::Verdict::improved, "gl:x",
                                       "step=2", changed("device_code")));
  EXPECT_THAT(markdown(result), HasSubstr("<summary>1 more</summary>"));
  EXPECT_THAT(markdown(result), HasSubstr("- **improved** cost: gl:x"));
}

TEST(Markdown, EscapesMarkup) {
  for (const std::string& name : test::hostile_strings()) {
    const std::string text = markdown(hostile(name));
    EXPECT_LT(text.size(), 65'000U);
    EXPECT_THAT(text, Not(HasSubstr("\n<script")));
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_THAT(text, Not(HasSubstr("line\nend")));
  }
  EXPECT_EQ(markdown_escaped("<script>`a`|*@me\x1b"),
            "&lt;script&gt;\\`a\\`\\|\\*@\u200Bme\\\\x1b");
}

TEST(Markdown, HasALimitedLength) {
  judge::GateResult result{.plan = "p", .run = "r", .findings = {}};
  for (int i = 0; i < 3000; ++i) {
    judge::Finding finding = some_result().findings.front();
    finding.device = fmt::format("gl:{}", i);
    finding.detail = std::string(2000, '<');
    result.findings.push_back(finding);
  }
  EXPECT_LT(markdown(result).size(), 65'000U);
}

}  // namespace
}  // namespace triptych::report
