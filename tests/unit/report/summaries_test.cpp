#include <gtest/gtest.h>

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
                               .configuration = "step=1",
                               .message = "too few runs"});
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

TEST(Markdown, ShowsTheWorstAndFoldsTheRest) {
  const std::string text = markdown(some_result());
  EXPECT_TRUE(text.starts_with("## volume/quick: FAIL"));
  EXPECT_NE(text.find("3 < 4 \\| pixels"), std::string::npos) << text;
  EXPECT_NE(text.find("<summary>3 more</summary>"), std::string::npos);
}

}  // namespace
}  // namespace triptych::report
