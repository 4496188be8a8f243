// Tests how command lines are parsed, and what help says about options.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using ::testing::HasSubstr;

const std::string one_step_plan = std::string(tiny_plan) + "step: [1]\n";

class Arguments : public testing::Test {
 protected:
  Arguments() { program.write("p.yaml", one_step_plan); }
  Program program;
};

TEST_F(Arguments, APlanMayFollowAnOption) {
  for (const std::string option : {"--device 'null:*'", "--set step=0.5", "--inject slowdown:5"}) {
    const Result result =
        program.run("run --store s.sqlite --device 'null:*' " + option + " p.yaml");
    EXPECT_EQ(result.code, 0) << result.output;
  }
  EXPECT_EQ(program.run("list --set step=0.5 p.yaml").code, 0);
  EXPECT_THAT(program.run("gate --check counters p.yaml --store s.sqlite --baselines b").output,
              HasSubstr("there are no baselines"));
}

// 10^10 pixels would need 160 GB of memory.
TEST_F(Arguments, AnImageWithTooManyPixelsIsRejected) {
  for (const char* size : {"100000", "100000x1", "16385", "0", "-1", "4294967297"}) {
    const Result result = program.run(
        std::string("render volume --device null:scripted --out o --set viewport=") + size);
    EXPECT_EQ(result.code, 3) << size << result.output;
    EXPECT_THAT(result.output, HasSubstr("1 to 16384 pixels per side")) << size;
  }
}

TEST_F(Arguments, AWordAfterAnOptionValueIsAPlan) {
  const Result result = program.run("run p.yaml --device 'null:*' extra.yaml --store s.sqlite");
  EXPECT_EQ(result.code, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("extra.yaml: cannot read"));
}

TEST_F(Arguments, EveryGlobMustMatchADevice) {
  for (const std::string command : {"run p.yaml --store s.sqlite", "validate"}) {
    const Result result = program.run(command + " --device 'null:*' --device 'vulcan:*'");
    EXPECT_EQ(result.code, 2) << result.output;
    EXPECT_THAT(result.output, HasSubstr("no device matches vulcan:*"));
    EXPECT_THAT(result.output, HasSubstr("null:scripted"));
  }
}

TEST_F(Arguments, AMissingDeviceListsTheDevices) {
  for (const std::string command :
       {"render volume --out o", "validate", "code volume", "reduce volume --out o"}) {
    const Result result = program.run(command);
    EXPECT_EQ(result.code, 3) << result.output;
    EXPECT_THAT(result.output, HasSubstr("--device is required; available devices:"));
    EXPECT_THAT(result.output, HasSubstr("null:scripted"));
  }
}

// The API of the glob has no device, but the message lists those of other APIs.
TEST_F(Arguments, AnUnknownDeviceOfAKnownApi) {
  const Result result = program.run("validate --device null");
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_THAT(result.output, HasSubstr("null:scripted"));
}

TEST_F(Arguments, TheListOfDevicesBeginsWithATable) {
  const Result result = program.run("devices --device 'null:*'");
  ASSERT_EQ(result.code, 0) << result.output;
  EXPECT_EQ(result.output.find("device "), 0U) << result.output;
  EXPECT_THAT(result.output.substr(0, result.output.find("\n\n")),
              testing::MatchesRegex("device +driver +clock +usable\nnull:scripted +1 .*yes"));
}

TEST_F(Arguments, ARunReportsTheClocksOfItsTimes) {
  const std::string run =
      "run volume/quick --device 'null:*' --set technique=raycast --set data=generate:mandelbulb:8 "
      "--set viewport=8 --store clocks.sqlite";
  EXPECT_THAT(program.run(run, R"({"base_ns": 1e5, "device_over_wall": 0.98})").output,
              HasSubstr("null:scripted: times use the device clock\n"));
  EXPECT_THAT(program.run(run, R"({"base_ns": 1e5, "device_over_wall": 0.1})").output,
              HasSubstr("null:scripted: times use the wall clock; in the previous run"));
  EXPECT_EQ(program.run(run + " --untimed").output.find("times use"), std::string::npos);
}

TEST_F(Arguments, APlanWithoutAName) {
  const Result result = program.run("run ''");
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.output, HasSubstr("no plan was given"));
}

TEST_F(Arguments, BaselinesWithoutAName) {
  ASSERT_EQ(program.run("run p.yaml --device 'null:*' --store s.sqlite").code, 0);
  for (const std::string command : {"accept p --reason new", "gate p", "report"}) {
    const Result result = program.run(command + " --store s.sqlite --baselines ''");
    EXPECT_EQ(result.code, 3) << result.output;
    EXPECT_THAT(result.output, HasSubstr("the name of the folder is empty"));
  }
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "p"));
}

TEST_F(Arguments, HelpNamesEveryFaultAndChoice) {
  const std::string help = program.run("run --help").output;
  for (const char* const fault : {"coarse_filter", "small_sprite", "missing_barrier", "hang"}) {
    EXPECT_THAT(help, HasSubstr(fault));
  }
  EXPECT_THAT(help, HasSubstr("adapt"));
  EXPECT_THAT(program.run("render --help").output, HasSubstr("particles"));
}

TEST_F(Arguments, AnUnreadableFolderIsNotAnError) {
  namespace fs = std::filesystem;
  if (::geteuid() != 0) GTEST_SKIP() << "needs root, which can enter any folder";
  fs::permissions(program.folder(), fs::perms::owner_read);
  const Result version =
      program.run("--version", "{}", "setpriv --reuid 65534 --regid 65534 --clear-groups");
  fs::permissions(program.folder(), fs::perms::owner_all);
  if (version.output.find("setpriv") != std::string::npos) GTEST_SKIP() << version.output;
  EXPECT_EQ(version.code, 0) << version.output;
}

// Progress and errors go to stderr. A run must continue even if writing to stderr fails.
TEST_F(Arguments, ARunContinuesIfStderrFails) {
  const std::string full = R"(sh -c 'exec "$0" "$@" 2> /dev/full')";
  const Result measured = program.run("run p.yaml --device 'null:*' --store s.sqlite", "{}", full);
  EXPECT_EQ(measured.code, 0);
  EXPECT_THAT(measured.output, HasSubstr("1 measured"));
  EXPECT_EQ(program.run("list nowhere.yaml", "{}", full).code, 3);
}

TEST_F(Arguments, InvalidUtf8IsRejectedWithItsPosition) {
  program.write("bytes.yaml", "suite: volume\ndata: [a\xff.nrrd]\n");
  const Result listed = program.run("list bytes.yaml --json");
  EXPECT_EQ(listed.code, 3);
  EXPECT_THAT(listed.output, HasSubstr("bytes.yaml:2:8: 'data'"));
  // The name of a plan is taken from the name of its file, which may contain any bytes.
  program.write("p\xff.yaml", one_step_plan);
  const Result named = program.run("list 'p\xff.yaml' --json");
  EXPECT_EQ(named.code, 0) << named.output;
  EXPECT_FALSE(nlohmann::json::parse(named.output).empty());
}

}  // namespace
}  // namespace triptych::command_line
