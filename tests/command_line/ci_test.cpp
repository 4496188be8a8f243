// Runs the scripts of ci/ with replacements for all programs that they call, and checks the
// arguments of these calls and the exit codes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::command_line {
namespace {

namespace fs = std::filesystem;
using test::Result;
using testing::HasSubstr;

// Replaces the program triptych: records its arguments, and exits with the code in the variable
// GATE.
constexpr const char* stand_in_program = R"(#!/bin/sh
echo "$*" >> calls
exit ${GATE:-0}
)";

class Ci : public testing::Test {
 protected:
  Ci() {
    for (const char* each :
         {"ci", "build", "build/release", "build/release/src", "build/release/src/app"}) {
      fs::create_directory(folder.path() / each);
    }
    for (const char* script : {"ci/gate", "ci/build"}) {
      fs::copy_file(fs::path(TRIPTYCH_SOURCE_FOLDER) / script, folder.path() / script);
    }
    static_cast<void>(folder.write("ci/environment", ""));
    make("ci/setup", "#!/bin/sh\n");
    make("build/release/src/app/triptych", stand_in_program);
  }

  // `environment` has the form NAME=VALUE…
  [[nodiscard]] Result gate(const std::string& environment,
                            const std::string& arguments = {}) const {
    make("ci/build", "#!/bin/sh\n");
    return run(environment, "ci/gate " + arguments);
  }

  [[nodiscard]] Result run(const std::string& environment, const std::string& command) const {
    return test::run_command("cd '" + folder.path().string() + "' && rm -f calls && env " +
                             environment + " " + command);
  }

  test::TemporaryFolder folder;

 private:
  void make(const std::string& name, std::string_view text) const {
    static_cast<void>(folder.write(name, text));
    fs::permissions(folder.path() / name, fs::perms::owner_all);
  }
};

TEST_F(Ci, ExitsWithTheCodeOfTheProgram) {
  for (const int code : {0, 1, 2, 3}) {
    EXPECT_EQ(gate("GATE=" + std::to_string(code)).code, code);
  }
}

TEST_F(Ci, KeepsAllFilesInOneFolder) {
  EXPECT_EQ(gate("TRIPTYCH_OUT=kept", "--require 'vulkan:*'").code, 0);
  EXPECT_EQ(folder.read("calls"),
            "gate --measure --store kept/gate.sqlite --out kept --require vulkan:*\n");
}

TEST_F(Ci, AFolderThatCannotBeCreatedIsNotARegression) {
  EXPECT_EQ(gate("TRIPTYCH_OUT=/proc/none").code, 3);
}

TEST_F(Ci, HelpMeasuresNothing) {
  const Result help = gate("GATE=1", "--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.output, HasSubstr("Exit code: 0 pass, 1 regression"));
  EXPECT_EQ(folder.read("calls"), "");
}

TEST_F(Ci, ATooOldReleaseIsReportedInOneLine) {
  std::string setup = test::run_command("cat '" TRIPTYCH_SOURCE_FOLDER "/ci/setup'").output;
  const std::string_view facts = "/etc/os-release";
  ASSERT_NE(setup.find(facts), std::string::npos);
  setup.replace(setup.find(facts), facts.size(), "./os-release");
  static_cast<void>(folder.write("ci/setup", setup));
  static_cast<void>(folder.write("ci/packages.txt", "[run]\n"));
  static_cast<void>(folder.write("os-release", "ID=debian\nVERSION_ID=\"11\"\n"));
  const Result old = run("", "ci/setup --run");
  EXPECT_EQ(old.code, 3);
  EXPECT_EQ(old.output, "setup: Debian 11 is too old; Debian 12 or later is required\n");
  // Debian testing has no version number yet.
  static_cast<void>(folder.write("os-release", "ID=debian\n"));
  EXPECT_EQ(run("", "ci/setup --run").code, 0);
}

TEST_F(Ci, ATooOldCompilerIsReportedInOneLine) {
  static_cast<void>(folder.write("CMakeLists.txt",
                                 "cmake_minimum_required(VERSION 3.25)\n"
                                 "project(old LANGUAGES NONE)\nset(CMAKE_CXX_COMPILER_ID GNU)\n"
                                 "set(CMAKE_CXX_COMPILER_VERSION 11.4.0)\n"
                                 "include(" TRIPTYCH_SOURCE_FOLDER "/cmake/oldest.cmake)\n"));
  const Result old = run("", "cmake -G Ninja -B build");
  EXPECT_NE(old.code, 0);
  EXPECT_THAT(old.output, HasSubstr("GNU 11.4.0 is too old"));
}

TEST_F(Ci, ABuildNeedsAPreset) {
  const Result refused = run("", "ci/build");
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.output, HasSubstr("ci/build PRESET"));
}

}  // namespace
}  // namespace triptych::command_line
