// Tests that wrong usage and bad input lead to one clear line and the expected exit code.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace triptych::command_line {
namespace {

void expect_refused(const Result& result, int code, std::string_view expected) {
  EXPECT_EQ(result.code, code) << result.output;
  EXPECT_NE(result.output.find(expected), std::string::npos) << result.output;
  EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
}

TEST(Usage, HelpIsNotAnError) {
  const Program program;
  EXPECT_EQ(program.run("--help").code, 0);
  EXPECT_EQ(program.run("run --help").code, 0);
}

TEST(Usage, NoCommandAndAnUnknownOne) {
  const Program program;
  EXPECT_EQ(program.run("").code, 3);
  expect_refused(program.run("fly"), 3,
                 "unknown command 'fly'; expected one of: devices, list, run,");
}

TEST(Usage, ListShowsAllFactorsOfASuite) {
  const Program program;
  const Result listed = program.run("list volume");
  EXPECT_EQ(listed.code, 0) << listed.output;
  for (const char* text :
       {"  step: 0.015625 to 4096 | own; default 1\n", "distance between samples",
        "  skip: none | bricks | distance; default distance; does not change the image\n",
        "  generate:mandelbulb\n", "  volume/quick: "}) {
    EXPECT_NE(listed.output.find(text), std::string::npos) << text << '\n' << listed.output;
  }
  const auto json = nlohmann::json::parse(program.run("list particles --json").output);
  for (const char* part : {"factors", "generators", "plans"}) {
    ASSERT_FALSE(json.at(part).empty()) << part;
    for (const auto& each : json.at(part)) EXPECT_NE(each.at("summary"), "") << each;
  }
}

// The scripted device cannot record the history of a pixel with any quadrature.
TEST(Usage, AHistoryThatTheDeviceCannotRecordIsNotBlamedOnTheQuadrature) {
  const Program program;
  const Result result =
      program.run(std::string("render volume ") + tiny + " --out frame --pixel 1,1");
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_EQ(result.output.find("quadrature"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("history of a pixel"), std::string::npos) << result.output;
}

TEST(Usage, AMissingPlan) {
  const Program program;
  expect_refused(program.run("list volume/quik"), 3, "did you mean 'quick'?");
  expect_refused(program.run("list nowhere.yaml"), 3, "nowhere.yaml");
}

TEST(Usage, MistakesInAPlanNameLineAndColumn) {
  const Program program;
  program.write("unknown.yaml", "suite: volume\nstepp: [1]\n");
  expect_refused(program.run("list unknown.yaml"), 3, "unknown.yaml:2:1: unknown factor 'stepp'");
  program.write("type.yaml", "suite: volume\nstep: [fast]\n");
  expect_refused(program.run("list type.yaml"), 3, "type.yaml:2:8:");
  program.write("empty.yaml", "suite: volume\nstep: []\n");
  expect_refused(program.run("list empty.yaml"), 3, "empty.yaml:2:");
  program.write("twice.yaml", "suite: volume\nstep: [1]\nstep: [2]\n");
  expect_refused(program.run("list twice.yaml"), 3, "twice.yaml:3:");
}

TEST(Usage, InvalidOverrides) {
  const Program program;
  expect_refused(program.run("list volume/quick --set stepp=1"), 3, "did you mean 'step'?");
  expect_refused(program.run("list volume/quick --set step"), 3, "expected factor=value");
  expect_refused(program.run("run volume/quick particles/quick --set step=1"), 3, "one plan");
  expect_refused(program.run("list volume/quick --set viewport=0"), 3, "viewport '0'");
  for (const char* shard : {"3/2", "0/1", "1/", "1/2/3", "4294967297/1", "1/4294967297"}) {
    expect_refused(program.run(std::string("list volume/quick --shard ") + shard), 3,
                   "expected i/n");
  }
  EXPECT_EQ(program.run("list volume/quick --shard 2/2").code, 0);
}

TEST(Usage, ASuiteCannotBeOverridden) {
  const Program program;
  for (const char* choice : {"--set nonsense=1", "--shard 9/2", "--filter x"}) {
    expect_refused(program.run(std::string("list volume ") + choice), 3,
                   "volume is a suite, but options that select configurations need a plan");
  }
}

TEST(Usage, InvalidGenerators) {
  const Program program;
  program.write("small.yaml",
                "suite: volume\ndata: [generate:mandelbulb:16, generate:mandelbulb:-5]\n");
  expect_refused(
      program.run("list small.yaml"), 3,
      "small.yaml:2:32: 'data': generate:mandelbulb: size -5 is out of range; expected 1 to 4096");
  expect_refused(program.run("run volume/quick --set data=generate:mandelbulb:999999"), 3,
                 "size 999999 is out of range; expected 1 to 4096");
  expect_refused(program.run("list volume/quick --set data=generate:mandelbulb"), 3,
                 "expected generate:NAME:SIZE");
  expect_refused(program.run("list volume/quick --set data=generate:mandelbrot:16"), 3,
                 "unknown volume generator 'mandelbrot'");
  expect_refused(program.run("list particles/quick --set data=generate:uniform:0"), 3,
                 "expected a count from 1 to 20000000");
  expect_refused(program.run("list particles/quick --set data=generate:uniform:-1"), 3,
                 "expected generate:NAME:COUNT");
}

TEST(Usage, AMissingDevice) {
  const Program program;
  expect_refused(program.run("run volume/quick --device 'none:*'"), 2, "no device matches none:*");
}

TEST(Usage, AnUnknownApiReportsHowItsWorkerEnded) {
  const Program program;
  expect_refused(program.run("compare volume/quick --a bogus:x --b null:scripted"), 2,
                 "the worker exited with code 3; the worker's last output: triptych: unknown API");
}

// The message of an interrupted command suggests the option with which that command can be resumed,
// if there is one.
TEST(Usage, AnInterruptSuggestsResumeIfPossible) {
  const Program program;
  const std::string hang = std::string("--set data=generate:gaussian_blob:16 --set viewport=16 ") +
                           "--device null:scripted";
  const std::string script = R"({"failures": [{"kind": "hang", "at": "open"}]})";
  const std::string interrupted = "timeout --foreground -s INT 2";
  expect_refused(program.run("render volume " + hang + " --out frame", script, interrupted), 124,
                 "triptych: interrupted\n");
  const Result run = program.run("run volume/quick " + hang, script, interrupted);
  EXPECT_NE(
      run.output.find("interrupted; the records so far are in the store; use --resume to continue"),
      std::string::npos)
      << run.output;
}

TEST(Usage, ValidatingWithoutADeviceOrFolder) {
  const Program program;
  expect_refused(program.run("validate --device 'null:*' --out /proc/none"), 3,
                 "cannot write to folder");
  expect_refused(program.run("validate --device 'none:*'"), 2, "no device matches none:*");
}

TEST(Usage, AReadOnlyFolder) {
  const Program program;
  expect_refused(program.run("run volume/quick --device 'null:*' --store /proc/none/s.sqlite"), 3,
                 "cannot write to folder");
}

TEST(Usage, AnInvalidStore) {
  const Program program;
  program.write("text.sqlite", "this is no database, however long one looks at it");
  expect_refused(program.run("gate volume/quick --store text.sqlite"), 3, "text.sqlite");
  expect_refused(program.run("gate volume/quick --store none.sqlite"), 2,
                 "the store none.sqlite does not exist");
  expect_refused(program.run("gate volume/quick --store none.sqlite --check colour"), 3,
                 "unknown check 'colour'");
}

TEST(Usage, AdviceNamesThePlanAsItWasTyped) {
  const Program program;
  ASSERT_EQ(program.run(std::string("run volume/quick --untimed --store s.sqlite ") + tiny).code,
            0);
  program.write("my.yaml", tiny_plan);
  expect_refused(program.run("gate my.yaml --store s.sqlite"), 2,
                 "no run of my; measure first with `triptych run my.yaml --store s.sqlite`");
}

// In this test, the two output streams are not joined. The # at the end comments out the
// redirection that would join them.
TEST(Usage, FailingToWriteOutputIsAnError) {
  const Program program;
  for (const char* command :
       {"list volume/quick", "list volume/quick --json", "--help", "--version"}) {
    const Result result = program.run(std::string(command) + " 2>&1 > /dev/full #");
    EXPECT_EQ(result.code, 3) << command;
    EXPECT_NE(result.output.find("No space left on device"), std::string::npos) << result.output;
  }
}

TEST(Usage, ADamagedVolume) {
  const Program program;
  program.write("short.nrrd",
                "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\nabc");
  const Result result =
      program.run("render volume --device 'null:scripted' --set data=short.nrrd --out frame");
  expect_refused(result, 3, "short.nrrd");
  EXPECT_EQ(program.run("render volume --device 'null:scripted' --set data=gone.nrrd --out p").code,
            3);
}

}  // namespace
}  // namespace triptych::command_line
