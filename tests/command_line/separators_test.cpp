// Tests that every command accepts a file whose name contains the characters that separate factors
// and levels.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

namespace triptych::command_line {
namespace {

class Separators : public testing::Test {
 protected:
  Separators() {
    program.write("plan.yaml",
                  "suite: volume\ntechnique: [raycast]\ndata: ['a,b=c.nrrd', field.nrrd]\n"
                  "transfer_function: [haze]\nviewport: [16]\n");
    for (const char* file : {"a,b=c.nrrd", "field.nrrd"}) {
      program.write(file, "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" +
                              std::string(64, 'x'));
    }
  }

  static void expect_output(const Result& result, std::string_view text) {
    EXPECT_NE(result.output.find(text), std::string::npos) << result.output;
  }

  // Returns the verdict about the configuration with this data, from the gate's JSON.
  static std::string verdict(const Result& gate, const std::string& data) {
    const auto json = nlohmann::json::parse(gate.output, nullptr, false);
    for (const auto& finding : json.value("findings", nlohmann::json::array())) {
      const std::string configuration = finding.value("configuration", "");
      if (configuration.find("data=" + data + ",") != std::string::npos) return finding["verdict"];
    }
    return "none";
  }

  Program program;
};

TEST_F(Separators, OverridesAcceptWhatListPrints) {
  const Result all = program.run("list plan.yaml");
  expect_output(all, "data=a%2Cb%3Dc.nrrd,");
  for (const char* spelling : {"a%2Cb%3Dc.nrrd", "a%2Cb=c.nrrd"}) {
    const std::string set = "list plan.yaml --set data=" + std::string(spelling);
    expect_output(program.run(set), "plan: 1 configurations");
    EXPECT_EQ(program.run(set + ",field.nrrd").output, all.output);
  }
  expect_output(program.run("list plan.yaml --json"), "\"data\": \"a,b=c.nrrd\"");
}

TEST_F(Separators, RunAcceptGateReport) {
  ASSERT_EQ(program.run("run plan.yaml --device 'null:*' --store s.sqlite").code, 0);
  const Result accepted = program.run(
      "accept plan.yaml --only '*data=a%2Cb%3Dc.nrrd,*' --reason new --baselines b "
      "--store s.sqlite");
  ASSERT_EQ(accepted.code, 0) << accepted.output;
  const Result gate = program.run(
      "gate plan.yaml --check counters --baselines b --store s.sqlite --junit j.xml --json");
  EXPECT_EQ(verdict(gate, "a%2Cb%3Dc.nrrd"), "pass") << gate.output;
  EXPECT_EQ(gate.code, 2) << "the baselines lack the other configuration: " << gate.output;
  expect_output({.output = program.read("j.xml")}, "data=a%2Cb%3Dc.nrrd,");
  const Result report = program.run("report --store s.sqlite --out page.html");
  ASSERT_EQ(report.code, 0) << report.output;
  EXPECT_NE(program.read("page.html").find("data=a,b=c.nrrd"), std::string::npos);
}

TEST_F(Separators, Render) {
  const Result drawn = program.run(
      "render volume --device null:scripted --set data=a%2Cb=c.nrrd --set viewport=16 --out out");
  ASSERT_EQ(drawn.code, 0) << drawn.output;
  expect_output({.output = program.read("out/frame.json")}, "\"data\": \"a,b=c.nrrd\"");
}

}  // namespace
}  // namespace triptych::command_line
