// Wrong usage and bad input: one clear line, the code people expect.

#include <gtest/gtest.h>

#include <algorithm>

#include "program.hpp"

namespace triptych::command_line {
namespace {

void expect_refused(const Result& result, int code, std::string_view says) {
  EXPECT_EQ(result.code, code) << result.output;
  EXPECT_NE(result.output.find(says), std::string::npos) << result.output;
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
  EXPECT_EQ(program.run("fly").code, 3);
}

TEST(Usage, APlanThatIsNotThere) {
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

TEST(Usage, AnOverrideThatIsWrong) {
  const Program program;
  expect_refused(program.run("list volume/quick --set stepp=1"), 3, "did you mean 'step'?");
  expect_refused(program.run("list volume/quick --set step"), 3, "expected factor=value");
  expect_refused(program.run("run volume/quick particles/quick --set step=1"), 3, "one plan");
  expect_refused(program.run("list volume/quick --set viewport=0"), 3, "viewport '0'");
  expect_refused(program.run("list volume/quick --shard 3/2"), 3, "expected i/n");
}

TEST(Usage, ADeviceThatIsNotThere) {
  const Program program;
  expect_refused(program.run("run volume/quick --device 'none:*'"), 2, "no device matches none:*");
}

TEST(Usage, ValidatingNothing) {
  const Program program;
  expect_refused(program.run("validate --device 'null:*' --out /proc/none"), 3,
                 "cannot write into");
  expect_refused(program.run("validate --device 'none:*'"), 2, "no device matches none:*");
}

TEST(Usage, AFolderThatCannotBeWrittenInto) {
  const Program program;
  expect_refused(program.run("run volume/quick --device 'null:*' --store /proc/none/s.sqlite"), 3,
                 "cannot write into");
}

TEST(Usage, AStoreThatIsNoStore) {
  const Program program;
  program.write("text.sqlite", "this is no database, however long one looks at it");
  expect_refused(program.run("gate volume/quick --store text.sqlite"), 3, "text.sqlite");
  expect_refused(program.run("gate volume/quick --store none.sqlite"), 2, "there is no store");
}

TEST(Usage, AVolumeThatIsBroken) {
  const Program program;
  program.write("short.nrrd",
                "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\nabc");
  const Result result =
      program.run("render volume --device 'null:scripted' --set data=short.nrrd --out picture");
  expect_refused(result, 3, "short.nrrd");
  EXPECT_EQ(program.run("render volume --device 'null:scripted' --set data=gone.nrrd --out p").code,
            3);
}

}  // namespace
}  // namespace triptych::command_line
