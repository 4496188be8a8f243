// Compares two devices that follow a script with known speeds, and whose frames are drawn
// alternately.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

class Compare : public testing::Test {
 protected:
  // `keys` contains additional keys for the script, each preceded by a comma.
  [[nodiscard]] std::string script(double speed, int seed, const std::string& keys = "") const {
    return fmt::format(
        R"({{"images": {{"*": "{}"}}, "devices": [{}], "seed": {}, "base_ns": 5e6{}}})",
        image_file.string(), speed, seed, keys);
  }
  [[nodiscard]] std::string b_as(double speed, const std::string& keys = noise) const {
    return "null:scripted,TRIPTYCH_NULL_SCRIPT=" + script(speed, 2, keys);
  }

  [[nodiscard]] Result compare(const std::string& b, const std::string& more = "",
                               const std::string& keys_of_a = noise) const {
    return program.run(
        fmt::format("compare volume/quick --a null:scripted --b '{}' {} {}", b, tiny_plan, more),
        script(1, 1, keys_of_a));
  }

  static constexpr const char* noise = R"(, "noise": 0.01)";
  static constexpr const char* tiny_plan =
      "--set technique=raycast --set data=generate:gaussian_blob:16 "
      "--set transfer_function=haze --set viewport=16";
  Program program;
  std::filesystem::path image_file = correct_image(program);
};

// Returns the output with lines that were broken at 200 characters joined again.
std::string joined_lines(std::string output) {
  constexpr std::string_view breaks = "\n              ";
  for (std::size_t at = 0; (at = output.find(breaks, at)) != std::string::npos;) {
    output.replace(at, breaks.size(), " ");
  }
  return output;
}

void expect_verdict(const Result& result, int code, std::string_view expected) {
  EXPECT_EQ(result.code, code) << result.output;
  EXPECT_NE(joined_lines(result.output).find(expected), std::string::npos) << result.output;
}

TEST_F(Compare, ASideIsNotSlowerThanAnIdenticalOne) {
  expect_verdict(compare(b_as(1)), 0, "PASS: 1 same");
}

TEST_F(Compare, FindsFivePercentInBothDirections) {
  const Result slower = compare(b_as(1.05));
  expect_verdict(slower, 1, "FAIL: 1 slower");
  EXPECT_NE(slower.output.find(" ms ("), std::string::npos) << slower.output;
  EXPECT_NE(slower.output.find("5 repetitions in new processes"), std::string::npos)
      << slower.output;
  expect_verdict(compare(b_as(1 / 1.05)), 0, "PASS: 1 faster");
}

TEST_F(Compare, AnInjectedSlowdownAffectsOnlySideB) {
  expect_verdict(compare(b_as(1), "--inject slowdown:5"), 1, "FAIL: 1 slower");
  expect_verdict(compare(b_as(1), "--inject 'slowdown:5@*step=7*'"), 0, "PASS: 1 same");
}

TEST_F(Compare, TooMuchNoiseGivesNoVerdictButAdvice) {
  const char* much = R"(, "noise": 0.3)";
  const Result result = compare(b_as(1, much), "", much);
  expect_verdict(result, 2, "undecided");
  EXPECT_NE(result.output.find("384 measurement blocks"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("if there is a difference, it is smaller than"), std::string::npos)
      << result.output;
  // All blocks were measured, so the same command would not lead to a verdict.
  EXPECT_EQ(result.output.find("to reach a verdict, run"), std::string::npos) << result.output;
}

// The variable has no effect on the scripted device, as if a loader had ignored it.
TEST_F(Compare, ADriverThatIsComparedWithItselfIsReported) {
  const auto compare_with = [&](const std::string& variable, const std::string& more = "") {
    return program.run(fmt::format("compare volume/quick --a null:scripted --b null:scripted,{} {} "
                                   "--no-times {}",
                                   variable, tiny_plan, more),
                       script(1, 1));
  };
  expect_verdict(compare_with("VK_DRIVER_FILES=/next.json"), 0,
                 "\n! Both sides loaded the same driver version");
  const Result json = compare_with("VK_DRIVER_FILES=/next.json", "--json");
  EXPECT_EQ(nlohmann::json::parse(json.output.substr(json.output.find("\n{") + 1))
                .at("ineffective_variables"),
            nlohmann::json::array({"VK_DRIVER_FILES"}));
  const Result setting = compare_with("LP_NATIVE_VECTOR_WIDTH=128");
  EXPECT_EQ(setting.output.find("\n!"), std::string::npos) << setting.output;
}

TEST_F(Compare, AWrongImageIsARegressionWhateverTheTime) {
  const std::string wrong = R"(, "failures": [{"kind": "wrong_image", "at": "image"}])";
  const Result result = compare(b_as(0.5, wrong));
  expect_verdict(result, 1, "pixels exceed the error bound of the reference image");
  EXPECT_NE(joined_lines(result.output).find("the image of side b is wrong"), std::string::npos)
      << result.output;
}

TEST_F(Compare, ACrashOfBIsARegressionButOfACannotBeJudged) {
  expect_verdict(compare(b_as(1), "--inject crash"), 1,
                 "side b crashed: the worker was killed by SIGSEGV");
  const Result of_a = program.run(
      fmt::format("compare volume/quick --a null:scripted --b '{}' {}", b_as(1), tiny_plan),
      script(1, 1, R"(, "failures": [{"kind": "crash", "at": "prepare", "only": "*width=16,*"}])"));
  expect_verdict(of_a, 2,
                 "technique=raycast,viewport=16: side a crashed: the worker was killed by SIGABRT");
}

TEST_F(Compare, WithoutTimesOnlyDeterministicResultsAreReported) {
  expect_verdict(compare(b_as(1.05), "--no-times"), 0, "PASS: 0 deterministic regressions");
  const std::string wrong = R"(, "failures": [{"kind": "wrong_image", "at": "image"}])";
  const Result result = compare(b_as(1, wrong), "--no-times");
  expect_verdict(result, 1, "FAIL: 1 deterministic regression");
  EXPECT_EQ(result.output.find("slower"), std::string::npos) << result.output;
}

TEST_F(Compare, LeavesNoFilesUnlessAStoreIsNamed) {
  expect_verdict(compare(b_as(1), "--no-times"), 0, "PASS");
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "triptych.sqlite"));
  expect_verdict(compare(b_as(1), "--no-times --store kept.sqlite"), 0, "PASS");
  EXPECT_TRUE(std::filesystem::exists(program.folder() / "kept.sqlite"));
}

TEST_F(Compare, TheGateCanCompareWithABase) {
  const auto gate = [&](const std::string& more) {
    return program.run(
        fmt::format("gate volume/quick --device null:scripted {} {}", tiny_plan, more),
        script(1, 1));
  };
  expect_verdict(gate("--base TRIPTYCH_NULL_SCRIPT='" + script(1, 2) + "'"), 0, "PASS");
  expect_verdict(gate("--base " TRIPTYCH_PROGRAM), 0, "PASS");
  expect_verdict(gate("--base " TRIPTYCH_PROGRAM " --inject crash"), 1, "side b crashed");
  expect_verdict(gate("--base nothing"), 3,
                 "--base nothing: expected an executable program or NAME=VALUE");
  expect_verdict(gate("--base /bin/true"), 3,
                 "--base /bin/true: this program is not a build of triptych");
  expect_verdict(gate("--base " TRIPTYCH_PROGRAM " --measure"), 3, "excludes");
  expect_verdict(gate("--bisect --base " TRIPTYCH_PROGRAM " --measure"), 125, "excludes");
  expect_verdict(gate("--bisect --no-such-option"), 125, "no-such-option");
}

TEST_F(Compare, AnUntrustedClockIsNotUsed) {
  const Result result = compare(b_as(1, R"(, "noise": 0.01, "device_over_wall": 0.1)"));
  expect_verdict(result, 0, "the device clock of side b failed its calibration");
}

TEST_F(Compare, JsonContainsTheSameResult) {
  const Result result = compare(b_as(1.05), "--json");
  ASSERT_EQ(result.code, 1) << result.output;
  const auto json = nlohmann::json::parse(
      result.output.substr(result.output.find("\n{") + 1));  // skips the progress output
  EXPECT_EQ(json.at("exit_code"), 1);
  const auto& compared = json.at("configurations").at(0);
  // The scripted times have a noise of 1 %. A block uses the smallest time of several batches,
  // which is smaller than the mean. Even the smallest of 30 normally distributed values is on
  // average only 2.04 standard deviations below the mean, so the medians must be within 3 % of the
  // scripted times.
  EXPECT_NEAR(compared.at("a").at("median_ns").get<double>(), 5e6, 0.03 * 5e6);
  EXPECT_NEAR(compared.at("b").at("median_ns").get<double>(), 5.25e6, 0.03 * 5.25e6);
  EXPECT_LT(compared.at("b").at("lower_quartile_ns"), compared.at("b").at("median_ns"));
  EXPECT_GT(compared.at("b").at("upper_quartile_ns"), compared.at("b").at("median_ns"));
  EXPECT_EQ(compared.at("verdict"), "slower");
  EXPECT_NEAR(compared.at("ratio").get<double>(), 1.05, 0.02);
  EXPECT_LT(compared.at("ratio_low"), compared.at("ratio_high"));
}

TEST_F(Compare, WrongUsageIsReportedInOneLine) {
  EXPECT_EQ(program.run("compare volume/quick --a null:scripted").code, 3);
  expect_verdict(compare("null"), 3, "expected a device such as");
  expect_verdict(compare("null:scripted,FAST"), 3, "after the device: expected NAME=VALUE");
  expect_verdict(compare(b_as(1), "--inject wings"), 3, "unknown fault 'wings'");
  expect_verdict(compare(b_as(1), "--b-program nothing"), 3, "is not an executable program");
  expect_verdict(compare("null:scripted,LP_PERF=no_tex"), 3, "LP_PERF=no_tex is set");
  expect_verdict(compare("null:nothing"), 2, "null:nothing cannot be opened");
}

TEST_F(Compare, AnotherProgramCanServeSideB) {
  expect_verdict(compare(b_as(1), "--b-program " TRIPTYCH_PROGRAM), 0, "PASS: 1 same");
  expect_verdict(compare(b_as(1), "--b-program /bin/true"), 3,
                 "--b-program /bin/true: this program is not a build of triptych");
}

TEST_F(Compare, SideBySideNeedsAStoreWithTwoDevices) {
  expect_verdict(program.run("compare --apis"), 3, "--apis needs --store");
  const std::string run = fmt::format("run volume/quick {} --store s.sqlite", tiny);
  ASSERT_EQ(program.run(run, script(1, 1)).code, 0);
  expect_verdict(program.run("compare --apis --store s.sqlite"), 2, "on more than one device");
  expect_verdict(program.run("compare volume/quick"), 3, "needs either two sides");
}

// `compare` stores each side as its own run, so `compare --apis` must read both runs.
TEST_F(Compare, SideBySideReadsTheStoreOfAComparison) {
  const std::string two = R"({"devices": [1, 1.7], "base_ns": 1e6})";
  const Result compared =
      program.run(fmt::format("compare volume/quick {} --a null:scripted --b 'null:scripted#2' "
                              "--budget 1 --store c.sqlite",
                              tiny_plan),
                  two);
  ASSERT_NE(compared.code, 3) << compared.output;
  const Result table = program.run("compare --apis --store c.sqlite", two);
  expect_verdict(table, 0, "null:scripted#2");
  EXPECT_NE(table.output.find("null:scripted "), std::string::npos) << table.output;
  EXPECT_NE(table.output.find("only one run"), std::string::npos) << table.output;
}

}  // namespace
}  // namespace triptych::command_line
