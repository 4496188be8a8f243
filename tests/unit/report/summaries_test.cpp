#include <fmt/format.h>
#include <gtest/gtest.h>

#include "report/finding_groups.hpp"
#include "report/junit.hpp"
#include "report/markdown.hpp"

namespace triptych::report {
namespace {

judge::GateResult some_result() {
  judge::GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
  result.findings.push_back({.check = judge::Check::image,
                             .verdict = judge::Verdict::regression,
                             .test = "volume.quick.image.gl:x",
                             .device = "gl:x",
                             .configuration = "step=1",
                             .message = "3 < 4 | pixels",
                             .numbers = {{"max_error", 0.5}}});
  for (int i = 0; i < 12; ++i) {
    result.findings.push_back({.check = judge::Check::timing,
                               .verdict = judge::Verdict::advisory,
                               .test = "volume.quick.timing.gl:x",
                               .device = "gl:x",
                               .configuration = fmt::format("step={}", i),
                               .message = fmt::format("now {} × their mean", i)});
  }
  return result;
}

TEST(Junit, CountsFailuresAndEscapes) {
  const std::string xml = junit(some_result());
  EXPECT_NE(xml.find("<testsuite name=\"volume/quick.image\" tests=\"1\" failures=\"1\" "
                     "errors=\"0\" skipped=\"0\">"),
            std::string::npos)
      << xml;
  EXPECT_NE(xml.find("skipped=\"12\""), std::string::npos);
  EXPECT_NE(xml.find("<failure message=\"3 &lt; 4 | pixels\"/>"), std::string::npos);
  EXPECT_NE(xml.find("<property name=\"max_error\" value=\"0.5\"/>"), std::string::npos);
}

TEST(Junit, IsUtf8WhateverADriverSays) {
  judge::GateResult result = some_result();
  result.findings.front().message = "GL_RENDERER \xff";
  EXPECT_EQ(junit(result).find('\xff'), std::string::npos);
}

TEST(Markdown, ShowsTheWorstAndFoldsTheRest) {
  const std::string text = markdown(some_result());
  EXPECT_TRUE(text.starts_with("## volume/quick: FAIL"));
  EXPECT_NE(text.find("3 < 4 \\| pixels"), std::string::npos) << text;
  EXPECT_NE(text.find("<summary>3 more</summary>"), std::string::npos);
}

judge::Finding finding(judge::Verdict verdict, const std::string& device,
                       const std::string& configuration) {
  return {.check = judge::Check::timing,
          .verdict = verdict,
          .test = "volume.quick.timing." + device,
          .device = device,
          .configuration = configuration,
          .message = "the same"};
}

TEST(FindingGroups, WhatIsSaidOfManyConfigurationsIsSaidOncePerDevice) {
  using enum judge::Verdict;
  const std::vector<judge::Finding> findings{
      finding(advisory, "gl:x", "step=1"), finding(advisory, "gl:x", "step=2"),
      finding(advisory, "gl:y", "step=1"), finding(skipped, "gl:x", "step=1"),
      finding(advisory, "gl:x", "step=4")};
  const std::vector<FindingGroup> groups = grouped(findings);
  ASSERT_EQ(groups.size(), 3);
  EXPECT_EQ(groups[0].subject(), "3 configurations");
  EXPECT_EQ(groups[0].first, findings.data());
  EXPECT_EQ(groups[1].subject(), "step=1");
  EXPECT_EQ(groups[1].first->device, "gl:y");
  EXPECT_EQ(groups[2].first->verdict, skipped);
}

TEST(FindingGroups, WhatFailedOrCouldNotBeJudgedStandsAlone) {
  using enum judge::Verdict;
  for (const judge::Verdict verdict : {regression, waived, cannot_judge}) {
    const std::vector<judge::Finding> findings{finding(verdict, "gl:x", "step=1"),
                                               finding(verdict, "gl:x", "step=2")};
    EXPECT_EQ(grouped(findings).size(), 2) << judge::name_of(verdict);
  }
}

TEST(FindingGroups, FindingsAboutADeviceStandAlone) {
  const std::vector<judge::Finding> findings(2, finding(judge::Verdict::advisory, "gl:x", ""));
  ASSERT_EQ(grouped(findings).size(), 2);
  EXPECT_EQ(grouped(findings)[0].subject(), "");
}

}  // namespace
}  // namespace triptych::report
