// Tests the output of a gate in a log file, on a terminal, and in a CI job.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* gate =
    "gate volume/quick --measure --store s.sqlite --device 'null:*' --set technique=raycast "
    "--set data=generate:gaussian_blob:16 --set transfer_function=haze --set viewport=16 ";
// A gate whose plan has 48 configurations.
constexpr const char* many =
    "gate volume/quick --measure --store s.sqlite --baselines b --device 'null:*' --set "
    "technique=raycast --set data=generate:gaussian_blob:8 --set viewport=8 --set "
    "transfer_function=haze --set camera=orbit_y:*/12 --set step=0.5,1,2,4 ";

long line_count(const std::string& text) {
  return std::ranges::count(text, '\n');
}

TEST(Log, IsShortWithoutATerminal) {
  const Program program;
  const Result accepted = program.run(std::string(many) + "--check counters");
  EXPECT_EQ(accepted.code, 2) << accepted.output;  // no baselines
  ASSERT_EQ(program.run("accept --reason new --baselines b --store s.sqlite").code, 0);
  const Result green = program.run(std::string(many) + "--check counters --out out");
  EXPECT_EQ(green.code, 0) << green.output;
  EXPECT_LE(line_count(green.output), 60) << green.output;
  EXPECT_THAT(green.output, HasSubstr("volume/quick on null:scripted: 48 measured, 0 skipped"));
  EXPECT_THAT(green.output, Not(HasSubstr("1/48")));
  const Result red = program.run(std::string(many) + "--out out");  // every image is wrong
  EXPECT_EQ(red.code, 1) << red.output;
  EXPECT_LE(line_count(red.output), 100) << red.output;
  EXPECT_THAT(program.run(std::string(many) + "--verbose").output, HasSubstr("\n48/48 null:"));
}

// The program `script` runs triptych on a terminal, which has 80 columns here.
TEST(Log, LinesFitInto80Columns) {
  const Program program;
  if (test::run_command("command -v script").code != 0) GTEST_SKIP() << "script is not installed";
  program.write("command", std::string("stty cols 80 && TRIPTYCH_NULL_SCRIPT='{}' TRIPTYCH_DATA= "
                                       "'" TRIPTYCH_PROGRAM "' ") +
                               many);
  const Result shown = test::run_command("cd '" + program.folder().string() +
                                         "' && script -qec 'sh command' /dev/null");
  EXPECT_THAT(shown.output, HasSubstr("[####"));
  // Every progress line begins with the sequence that erases the previous line.
  std::string_view rest = shown.output;
  std::size_t bars = 0;
  for (std::size_t at = 0; (at = rest.find("\r\033[K")) != std::string_view::npos;) {
    rest.remove_prefix(at + 4);
    const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
    EXPECT_LT(line.size(), 80U) << line;
    if (line.find(" [") != std::string_view::npos) ++bars;
  }
  EXPECT_GE(bars, 48U);
}

class CiSystems : public testing::Test {
 protected:
  // Accepts baselines with a correct image. The tests then run the gate with a device that draws a
  // wrong image.
  void SetUp() override {
    ASSERT_EQ(program.run(gate, right()).code, 2);
    ASSERT_EQ(program.run("accept --reason new --baselines baselines --store s.sqlite").code, 0);
  }
  [[nodiscard]] std::string right() const {
    return fmt::format(R"({{"images": {{"*": "{}"}}}})", image_file.string());
  }

  Program program;
  std::filesystem::path image_file = correct_image(program);
};

TEST_F(CiSystems, GitHubGetsAnnotationsASummaryAndAFoldedLog) {
  const std::string environment =
      "env GITHUB_ACTIONS=true GITHUB_STEP_SUMMARY=summary GITHUB_REPOSITORY=a/b "
      "GITHUB_WORKFLOW_REF=a/b/.github/workflows/t.yml@refs/heads/main";
  const Result red = program.run(gate, "{}", environment);
  EXPECT_EQ(red.code, 1) << red.output;
  EXPECT_THAT(red.output, HasSubstr("::group::Measuring\n"));
  EXPECT_THAT(red.output, HasSubstr("::endgroup::\n"));
  EXPECT_THAT(red.output,
              HasSubstr("\n::error file=baselines/volume/quick/counters.json,line=2,title=image"));
  EXPECT_THAT(program.read("summary"), StartsWith("## FAIL (1)"));
  const Result green = program.run(gate, right(), environment);
  EXPECT_EQ(green.code, 0) << green.output;
  EXPECT_THAT(green.output, Not(HasSubstr("::error")));
  EXPECT_THAT(program.run(std::string(gate) + "--ci none", "{}", environment).output,
              Not(HasSubstr("::")));
}

TEST_F(CiSystems, GitLabGetsCodeQualityAndAFoldedLog) {
  const Result red = program.run(std::string(gate) + "--ci gitlab --out out", "{}");
  EXPECT_EQ(red.code, 1) << red.output;
  EXPECT_THAT(red.output, HasSubstr("\033[0Ksection_start:"));
  const auto issues = nlohmann::json::parse(program.read("out/codequality.json"));
  ASSERT_FALSE(issues.empty());
  EXPECT_EQ(issues[0]["severity"], "major");
  EXPECT_EQ(issues[0]["location"]["path"], "baselines/volume/quick/counters.json");
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "out2/codequality.json"));
}

TEST_F(CiSystems, AnUnknownSystemIsRejectedBeforeMeasuring) {
  const Result refused = program.run(std::string(gate) + "--ci jenkins");
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.output, StartsWith("triptych: --ci jenkins: expected auto, github"));
}

}  // namespace
}  // namespace triptych::command_line
