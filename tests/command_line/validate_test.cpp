// Tests known failures, flakes and shards of a validation. The scripted device draws patterns, so
// all of its images are wrong.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/image_io.hpp"
#include "measure/plan/plan.hpp"
#include "program.hpp"
#include "suites/volume/suite.hpp"

namespace triptych::command_line {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* part = "validate --device null:scripted --shard 1/400 ";

class Validate : public testing::Test {
 protected:
  // Returns the number of findings with each verdict in the output of --json.
  [[nodiscard]] std::map<std::string, int> verdicts(const std::string& file) const {
    std::map<std::string, int> counts;
    for (const auto& plan : nlohmann::json::parse(program.read(file))) {
      for (const auto& finding : plan.at("findings")) ++counts[finding.at("verdict")];
    }
    return counts;
  }
  Program program;
};

TEST_F(Validate, KnownFailuresAreWaivedAndNewOnesFail) {
  const Result first = program.run(std::string(part) + "--write-expect known.json --json 1.json");
  ASSERT_EQ(first.code, 1) << first.output;
  EXPECT_THAT(first.output, HasSubstr("failed configurations again"));
  EXPECT_THAT(program.read("known.json"), HasSubstr(R"("outcome":"fail")"));
  const Result second = program.run(std::string(part) + "--expect known.json --json 2.json");
  EXPECT_NE(second.code, 1) << second.output;
  EXPECT_THAT(second.output, Not(HasSubstr("failed configurations again")));
  EXPECT_EQ(verdicts("1.json")["regression"], verdicts("2.json")["waived"]);
  EXPECT_EQ(verdicts("2.json")["regression"], 0);
  const Result crashing = program.run(
      std::string(part) + "--expect known.json",
      R"({"failures": [{"kind": "crash", "at": "frame", "only": "technique=raycast,*"}]})");
  EXPECT_NE(crashing.code, 1) << "the expectation states that it fails, not how";
  program.write("none.json", "[]");
  EXPECT_EQ(program.run(std::string(part) + "--expect none.json").code, 1);
}

// The only configuration of volume/quick on this device is drawn correctly, except that one of its
// frames fails.
TEST_F(Validate, AFailureThatDoesNotRepeatIsReportedAsAFlake) {
  const auto suite = volume_suite::make_suite({});
  const measure::Plan plan = measure::load_plan(
      "volume/quick", {}, [&](std::string_view) -> measure::Suite& { return *suite; },
      {.index = 1, .count = 400});
  ASSERT_EQ(plan.configurations.size(), 1U);
  const measure::Configuration& only = plan.configurations.front();
  core::write_exr(suite->truth(only, {}).truth, program.folder() / "right.exr");
  const std::string glob =
      fmt::format("technique={},data={},*", only.at("technique"), only.at("data"));
  const std::string script = fmt::format(
      R"({{"images": {{"{0}": "right.exr"}}, "failures":
         [{{"kind": "crash", "at": "frame", "only": "{0}", "once": "crashed"}}]}})",
      glob);
  const Result result =
      program.run(std::string(part) + "--write-expect known.json --json j.json", script);
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(program.read("known.json"), HasSubstr(R"("outcome":"flake")"));
  EXPECT_THAT(program.read("validation/gate.log"),
              HasSubstr("flake (correct when drawn again): crashed: "));
  // Although the frame was correct when it was drawn again, the store must still contain the failed
  // record.
  const Result gate = program.run(
      "gate volume/quick --shard 1/400 --store validation/validation.sqlite --check image", script);
  EXPECT_EQ(gate.code, 1) << gate.output;
}

TEST_F(Validate, RepeatingListsEachCaseWithItsVerdicts) {
  const std::string script =
      R"({"failures": [{"kind": "crash", "at": "frame", "only": "*", "once": "crashed"}]})";
  const Result result = program.run(std::string(part) + "--repeat 3", script);
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.output, HasSubstr(" cases in 3 repetitions: "));
  std::istringstream lines(program.read("validation/repeats.jsonl"));
  std::size_t cases = 0;
  for (std::string line; std::getline(lines, line); ++cases) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json.at("verdicts").size(), 3U) << line;
    EXPECT_LE(json.at("images"), 1) << line;
  }
  EXPECT_GT(cases, 0U);
  EXPECT_EQ(program.run(std::string(part) + "--repeat 0").code, 3);
}

// The complete coverage has a hundred lines, so the terminal shows only a summary.
TEST_F(Validate, PrintsASummaryOfItsCoverageAndHowMuchItMeasures) {
  const Result result = program.run(part);
  EXPECT_THAT(result.output, testing::ContainsRegex(
                                 "measuring [0-9]+ configurations of [0-9]+ plans on 1 device\n"));
  EXPECT_THAT(result.output, HasSubstr("coverage of null:scripted: "));
  EXPECT_THAT(result.output, HasSubstr("validation/coverage.txt\n"));
  EXPECT_THAT(result.output, Not(HasSubstr("largest values in one frame")));
  EXPECT_THAT(program.read("validation/coverage.txt"), HasSubstr("largest values in one frame"));
}

TEST_F(Validate, AShardDoesNotLackTheRest) {
  const Result result = program.run(std::string(part) + "--json j.json");
  EXPECT_THAT(program.read("j.json"), Not(HasSubstr("missing rows")));
  EXPECT_EQ(program.run("validate --device null:scripted --shard 3/2").code, 3);
}

TEST_F(Validate, ParallelWorkersGiveTheSameVerdict) {
  ASSERT_EQ(program.run(std::string(part) + "--json 1.json").code, 1);
  const Result two = program.run(std::string(part) + "--jobs 2 --json 2.json");
  EXPECT_EQ(two.code, 1) << two.output;
  EXPECT_EQ(verdicts("1.json"), verdicts("2.json"));
  EXPECT_EQ(program.run(std::string(part) + "--jobs 0").code, 3);
}

TEST_F(Validate, InvalidExpectationFilesAreRejected) {
  EXPECT_EQ(program.run(std::string(part) + "--expect gone.json").code, 3);
  program.write("bad.json", R"([{"device": "a"}])");
  const Result bad = program.run(std::string(part) + "--expect bad.json");
  EXPECT_EQ(bad.code, 3) << bad.output;
  EXPECT_THAT(bad.output, HasSubstr("bad.json:1"));
  program.write("known.json", "[]");
  EXPECT_EQ(program.run(std::string(part) + "--expect known.json --write-expect known.json").code,
            3);
}

}  // namespace
}  // namespace triptych::command_line
