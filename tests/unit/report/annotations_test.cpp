#include "report/ci/annotations.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "findings.hpp"
#include "report/ci/junit.hpp"
#include "support/temporary_folder.hpp"
#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using testing::HasSubstr;
using testing::StartsWith;
using enum judge::Verdict;

// Provides a repository whose baseline file stores the second configuration in line 3.
class Annotations : public testing::Test {
 protected:
  Annotations() {
    std::filesystem::create_directories(folder.path() / "baselines/volume/quick");
    static_cast<void>(folder.write("baselines/volume/quick/counters.json",
                                   "{\n \"step=1\": {},\n \"step=2\": {}\n}\n"));
  }

  [[nodiscard]] FindingLocations locations() const {
    return FindingLocations({.repository = folder.path(),
                             .baselines = folder.path() / "baselines",
                             .job = ".github/workflows/triptych.yml"});
  }

  static judge::GateResult result_with(judge::Verdict verdict, const std::string& configuration,
                                       Check check = Check::counters) {
    judge::GateResult result{.plan = "volume/quick", .run = "r", .findings = {}};
    result.findings.push_back(
        finding_of(check, verdict, "gl:x", configuration, changed("samples")));
    return result;
  }

  test::TemporaryFolder folder;
};

TEST_F(Annotations, ARegressionIsAnErrorAtItsStoredValue) {
  const std::string text =
      github_annotations(std::vector{result_with(regression, "step=2")}, locations());
  EXPECT_THAT(text, StartsWith("::error file=baselines/volume/quick/counters.json,line=3,"
                               "title=counters%3A gl%3Ax::samples 3 → 4"));
  EXPECT_THAT(text, HasSubstr("%0Atriptych gate volume/quick --device gl:x --set step=2"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 1);
}

TEST_F(Annotations, FindingsThatCannotBeJudgedAreWarningsAtTheJob) {
  std::vector<judge::GateResult> results{result_with(cannot_judge, "step=7")};
  EXPECT_THAT(github_annotations(results, locations()),
              StartsWith("::warning file=.github/workflows/triptych.yml,line=1,"));
  results.front().findings.front().verdict = advisory;
  EXPECT_EQ(github_annotations(results, locations()), "");
}

TEST_F(Annotations, FilesOutsideTheRepositoryAreNotReferenced) {
  const FindingLocations elsewhere(
      {.repository = folder.path() / "other", .baselines = folder.path() / "baselines"});
  const judge::GateResult result = result_with(regression, "step=2");
  EXPECT_EQ(elsewhere.of(result.findings.front(), result).file, "");
}

TEST_F(Annotations, AreAtMostTen) {
  std::vector<judge::GateResult> results;
  for (int i = 0; i < 30; ++i) {
    results.push_back(result_with(regression, "step=2"));
    results.back().findings.front().device = fmt::format("gl:x{}", i);
  }
  const std::string text = github_annotations(results, locations());
  EXPECT_EQ(std::ranges::count(text, '\n'), 10);
}

TEST_F(Annotations, NamesCannotInjectCommands) {
  for (const std::string& name : test::hostile_strings()) {
    judge::GateResult result = result_with(regression, "step=" + name + "\n::set-env name=A::b");
    result.plan = result.findings.front().device = name + "\n::error::";
    const std::string text = github_annotations(std::vector{result}, locations());
    EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;
    EXPECT_EQ(text.find('\r'), std::string::npos);
    EXPECT_TRUE(nlohmann::json::accept(gitlab_code_quality(std::vector{result}, locations())));
  }
}

TEST_F(Annotations, CodeQualityContainsWhatGitLabRequires) {
  const auto issues = nlohmann::json::parse(
      gitlab_code_quality(std::vector{result_with(regression, "step=2")}, locations()));
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0]["severity"], "major");
  EXPECT_EQ(issues[0]["check_name"], "counters");
  EXPECT_EQ(issues[0]["location"]["path"], "baselines/volume/quick/counters.json");
  EXPECT_EQ(issues[0]["location"]["lines"]["begin"], 3);
  EXPECT_FALSE(issues[0]["fingerprint"].get<std::string>().empty());
}

// The times of all test cases in a JUnit file add up to the time of the run.
TEST_F(Annotations, JunitHasTimesFilesAndShortNames) {
  judge::GateResult result = result_with(regression, "step=2,technique=raycast");
  result.findings.push_back(finding_of(Check::image, pass, "gl:x", "step=2,technique=raycast"));
  const FindingLocations found = locations();
  const JunitFacts facts{
      .seconds = {{"volume/quick", {{{"gl:x", "step=2,technique=raycast"}, 1.5}}}},
      .locations = &found};
  const std::string xml = junit(result, facts);
  EXPECT_EQ(test::xml_fault(xml), "");
  EXPECT_THAT(xml, HasSubstr("name=\"raycast.s2\" time=\"1.500\" "
                             "file=\".github/workflows/triptych.yml\" line=\"1\">"));
  EXPECT_EQ(xml.find("time=\"1.500\""), xml.rfind("time=\"1.500\""));
  EXPECT_THAT(xml, HasSubstr("name=\"configuration\" value=\"step=2,technique=raycast\""));
}

}  // namespace
}  // namespace triptych::report
