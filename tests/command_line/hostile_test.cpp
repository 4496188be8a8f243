// Tests that malicious input leads to a one-line error, that nothing reaches the terminal
// unescaped, and that no command hangs.

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;
using testing::Not;

void expect_one_line(const Result& result, std::string_view expected) {
  EXPECT_EQ(result.code, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr(expected));
  EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
}

TEST(Hostile, PlanFilesAreListedForCTest) {
  const Program program;
  program.write("p.yaml", tiny_plan);
  const Result listed = program.run("ctest p.yaml --out tests.cmake --folder .");
  EXPECT_EQ(listed.code, 0) << listed.output;
  const std::string tests = program.read("tests.cmake");
  EXPECT_THAT(tests, HasSubstr("[=[volume.p.start]=]"));
  // The path must be absolute, because CTest may start the test in any folder.
  EXPECT_THAT(tests, HasSubstr("[=[" + (program.folder() / "p.yaml").string() + "]=]"));
}

// CMake would execute whatever follows the end of a bracket argument.
TEST(Hostile, NoNameEndsABracketArgumentInTheListForCTest) {
  const Program program;
  const std::string command = "execute_process(COMMAND touch ran)";
  int number = 0;
  for (const std::string& name :
       {"]=])" + command + "#", "]==])" + command + "#[==[]=]", std::string("a]=")}) {
    const std::string folder = "f" + std::to_string(number++) + "/" + name;
    std::filesystem::create_directories(program.folder() / folder);
    program.write(folder + "/p.yaml", tiny_plan);
    const Result listed = program.run("ctest '" + folder + "/p.yaml' --out tests.cmake --folder .");
    ASSERT_EQ(listed.code, 0) << listed.output;
    program.write("defined.cmake",
                  "function(add_test name program)\n  list(GET ARGN 1 plan)\n"
                  "  message(\"${plan}\")\nendfunction()\nfunction(set_tests_properties)\n"
                  "endfunction()\ninclude(tests.cmake)\n");
    const Result read =
        test::run_command("cd '" + program.folder().string() + "' && cmake -P defined.cmake 2>&1");
    EXPECT_EQ(read.code, 0) << read.output;
    EXPECT_FALSE(std::filesystem::exists(program.folder() / "ran")) << name;
    // The plan's path must appear unchanged as an argument.
    EXPECT_THAT(read.output, HasSubstr((program.folder() / folder / "p.yaml").string()));
  }
}

TEST(Hostile, AStoreWithADamagedIndexIsNotJudged) {
  const Program program;
  ASSERT_EQ(program.run(std::string("run volume/quick --store s.sqlite ") + tiny).code, 0);
  {
    SQLite::Database database((program.folder() / "s.sqlite").string(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA writable_schema = ON");
    database.exec(
        "UPDATE sqlite_schema SET rootpage = (SELECT rootpage FROM sqlite_schema WHERE name = "
        "'clock_of_device') WHERE name = 'run_of_plan'");
  }
  for (const char* command : {"report", "gate volume/quick", "accept volume/quick --reason x"}) {
    expect_one_line(program.run(std::string(command) + " --store s.sqlite --baselines b"),
                    "s.sqlite: is damaged");
  }
}

TEST(Hostile, RejectsPipesAndDeviceFilesAsPlans) {
  const Program program;
  ASSERT_EQ(::mkfifo((program.folder() / "pipe.yaml").c_str(), 0600), 0);
  for (const char* plan : {"pipe.yaml", "/dev/zero"}) {
    expect_one_line(program.run(std::string("list ") + plan, "{}", "timeout 20"),
                    "is a pipe or a device, not a regular file; expected a YAML file");
  }
}

TEST(Hostile, NamesAreEscapedForTheTerminal) {
  const Program program;
  program.write("a\x1b[2J\nb.yaml", "suite: volume\nstepp: [1]\n");
  for (const char* arguments :
       {"list \"$(printf 'a\\033[2J\\nb.yaml')\"", "list volume/quick \"$(printf '\\033[2J')\"",
        "\"$(printf '\\033[2J')\""}) {
    const Result result = program.run(arguments);
    EXPECT_EQ(result.code, 3);
    EXPECT_THAT(result.output, Not(HasSubstr("\x1b"))) << arguments;
    EXPECT_THAT(result.output, HasSubstr("\\x1b[2J")) << arguments;
  }
}

TEST(Hostile, LongLevelsAreShortenedInMessages) {
  const Program program;
  program.write("p.yaml", "suite: volume\nstep: [" + std::string(1'000'000, 'x') + "]\n");
  const Result result = program.run("list p.yaml");
  expect_one_line(result, "p.yaml:2:8");
  EXPECT_LT(result.output.size(), 9000U);
  EXPECT_THAT(result.output, HasSubstr("…"));
}

// The lines that a run prints to stdout and stderr must be escaped too.
TEST(Hostile, ARunEscapesNames) {
  const Program program;
  const std::string name = "a\x1b[2J\u202Eb.yaml";
  program.write(name, tiny_plan);
  for (const char* command : {"run", "list", "gate --measure"}) {
    const std::string store = std::string(command) == "list" ? "" : " --store s.sqlite";
    const Result result = program.run(std::string(command) + " '" + name + "'" + store + " 2>&1");
    for (const char* hidden : {"\x1b", "\u202E"}) {
      EXPECT_THAT(result.output, Not(HasSubstr(hidden))) << command;
    }
    EXPECT_THAT(result.output, HasSubstr("a\\x1b[2J\\u{202e}b")) << command;
  }
}

// 10¹² combinations must be rejected before the first one is listed.
TEST(Hostile, RejectsPlansWithTooManyCombinations) {
  const Program program;
  std::string numbers;
  std::string cameras;
  for (int i = 1; i <= 1000; ++i) {
    numbers += std::to_string(i) + ", ";
    cameras += "random:" + std::to_string(i) + ", ";
  }
  program.write("p.yaml", "suite: volume\nstep: [" + numbers + "]\ncamera: [" + cameras +
                              "]\nbudget: [" + numbers + "]\nviewport: [" + numbers + "]\n");
  for (const char* command : {"list p.yaml", "run p.yaml --store s.sqlite"}) {
    const Result result = program.run(command, "{}", "timeout 20");
    expect_one_line(result, "combinations, and this factor has the most values");
    EXPECT_LT(result.output.size(), 9000U) << command;
  }
}

}  // namespace
}  // namespace triptych::command_line
