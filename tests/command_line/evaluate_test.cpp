// Measuring planted slowdowns on scripted devices and judging the judge by them.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace triptych::command_line {
namespace {

constexpr const char* script =
    R"({"devices": [1, 1.7], "base_ns": 1e6, "ns_per_sample": 50, "noise": 0.002})";

constexpr const char* plan = R"(suite: volume
technique: [raycast]
data: [generate:gaussian_blob:12]
transfer_function: [haze]
step: [0.25, 0.35, 0.5, 0.7, 1, 1.4]
camera: [orbit_y:1/8]
viewport: [16, 20, 24, 32, 40, 48]
)";

class Evaluate : public testing::Test {
 protected:
  Evaluate() { program.write("plan.yaml", plan); }

  [[nodiscard]] Result measure(const std::string& what, const std::string& more) const {
    return program.run("evaluate --measure --plan plan.yaml --device 'null:*' --sizes 25 --what " +
                           what + " --trials 3 " + more,
                       script);
  }
  [[nodiscard]] nlohmann::json judge(const std::string& what) const {
    const Result result = program.run("evaluate --json --trials 3 --what " + what);
    return nlohmann::json::parse(result.output.substr(result.output.find("{\n")));
  }

  Program program;
};

// Hits and trials of one rate over all trials of a spread.
std::pair<int, int> rate(const nlohmann::json& result, const std::string& spread,
                         const std::string& name) {
  std::pair<int, int> sum;
  for (const auto& row : result.at("trials")) {
    if (row.at("spread") != spread || !row.contains(name)) continue;
    sum.first += row.at(name).at("hits").get<int>();
    sum.second += row.at(name).at("trials").get<int>();
  }
  return sum;
}

TEST_F(Evaluate, TurnsFindWhatIsPlanted) {
  const Result measured = measure("compare", "--configurations 2 --launches 3 --blocks 12");
  EXPECT_NE(measured.output.find("null:scripted plan launch 3"), std::string::npos)
      << measured.output;
  const nlohmann::json judged = judge("compare");
  EXPECT_EQ(rate(judged, "one configuration", "detected"), std::pair(6, 6)) << judged.dump(1);
  EXPECT_EQ(rate(judged, "none (A/A)", "false_alarms"), std::pair(0, 6));
  EXPECT_TRUE(judged.at("trials").at(0).contains("seconds_per_configuration"));
}

TEST_F(Evaluate, RunsFindWhatIsPlantedAndAreJudgedTheSameTwice) {
  const Result measured = measure("history,correlation", "--rounds 6 --planted-rounds 1");
  EXPECT_NE(measured.output.find("6 unplanted runs, 1 planted"), std::string::npos)
      << measured.output;
  const nlohmann::json judged = judge("history,correlation");
  for (const char* spread : {"one configuration", "one factor level", "everything"}) {
    const auto [hits, trials] = rate(judged, spread, "detected");
    EXPECT_EQ(hits, trials) << spread << judged.dump(1);
    EXPECT_GT(trials, 0) << spread;
  }
  EXPECT_EQ(rate(judged, "none (A/A)", "same_bytes"), std::pair(6, 6));
  EXPECT_EQ(judged.dump(), judge("history,correlation").dump());
}

TEST_F(Evaluate, ABrokenLineIsNamed) {
  std::filesystem::create_directory(program.folder() / "evaluation");
  program.write("evaluation/blocks.jsonl", "{\"plan\": \"p\"}\n");
  const Result result = program.run("evaluate --what compare");
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.output.find("blocks.jsonl:1: expected a line"), std::string::npos)
      << result.output;
}

TEST_F(Evaluate, ALineThatWasNotEndedIsNotThere) {
  const std::string few = "--configurations 1 --launches 1 --blocks 12";
  ASSERT_EQ(measure("compare", few).code, 0);
  const std::string whole = program.read("evaluation/blocks.jsonl");
  program.write("evaluation/blocks.jsonl", whole + whole.substr(0, whole.size() / 3));
  const Result judged = program.run("evaluate --what compare --trials 3");
  EXPECT_NE(judged.code, 3) << judged.output;
  EXPECT_NE(judged.output.find("did not end it"), std::string::npos) << judged.output;
  EXPECT_NE(measure("compare", few).code, 3);  // adds to what is whole
  EXPECT_NE(program.run("evaluate --what compare --trials 3").code, 3);
}

TEST_F(Evaluate, NothingMeasuredIsNothingJudged) {
  const Result result = program.run("evaluate");
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_NE(result.output.find("triptych evaluate --measure"), std::string::npos) << result.output;
  EXPECT_EQ(program.run("evaluate --what guess").code, 3);
  EXPECT_EQ(program.run("evaluate --measure --sizes 0 --device 'null:*'", script).code, 3);
}

}  // namespace
}  // namespace triptych::command_line
