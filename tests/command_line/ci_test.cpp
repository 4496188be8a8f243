// The scripts of ci/ with everything that they call replaced: what they ask for, and which code is
// theirs.

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
using testing::Not;

// Told by the environment what to answer. A gate without a store cannot judge.
constexpr const char* program = R"(#!/bin/sh
echo "$*" >> calls
case $1 in
  run) touch out/gate.sqlite; exit ${RUN:-0} ;;
  report) exit ${REPORT:-0} ;;
esac
case " $* " in *' --bogus '*) echo "bogus was not expected" >&2; exit 3 ;; esac
[ -e out/gate.sqlite ] || exit 2
case $2 in
  volume/quick) exit ${VOLUME:-0} ;;
  *) exit ${PARTICLES:-0} ;;
esac
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
    make("build/release/src/app/triptych", program);
  }

  // `environment`: NAME=VALUE…
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

TEST_F(Ci, TheWorstVerdictCounts) {
  EXPECT_EQ(gate("VOLUME=0 PARTICLES=0").code, 0);
  EXPECT_EQ(gate("VOLUME=2 PARTICLES=0").code, 2);
  EXPECT_EQ(gate("VOLUME=2 PARTICLES=1").code, 1);
  EXPECT_EQ(gate("VOLUME=1 PARTICLES=2").code, 1);
  EXPECT_EQ(gate("VOLUME=3 PARTICLES=1").code, 3);
  EXPECT_EQ(gate("VOLUME=1 PARTICLES=3").code, 3);
}

TEST_F(Ci, WhatIsNoVerdictIsHiddenByNone) {
  for (const char* codes :
       {"VOLUME=139 PARTICLES=0", "VOLUME=139 PARTICLES=1", "VOLUME=139 PARTICLES=2",
        "VOLUME=2 PARTICLES=139", "REPORT=139", "VOLUME=1 REPORT=3"}) {
    EXPECT_EQ(gate(codes).code, 3) << codes;
  }
}

// A plan that only crashed is a regression, which the gate tells and `run` does not.
TEST_F(Ci, JudgesWhatCouldNotBeMeasured) {
  EXPECT_EQ(gate("RUN=2 VOLUME=1").code, 1);
  EXPECT_EQ(gate("RUN=2").code, 2);
  EXPECT_EQ(gate("RUN=3").code, 3);
  EXPECT_THAT(folder.read("calls"), Not(HasSubstr("report")));
}

TEST_F(Ci, AFolderThatCannotBeMadeIsNoRegression) {
  EXPECT_EQ(gate("TRIPTYCH_OUT=/proc/none").code, 3);
}

TEST_F(Ci, WrongArgumentsAreRefusedBeforeAnythingIsMeasured) {
  const Result refused = gate("VOLUME=0", "--bogus");
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.output, HasSubstr("bogus was not expected"));
  EXPECT_THAT(folder.read("calls"), Not(HasSubstr("run ")));
}

TEST_F(Ci, HelpMeasuresNothing) {
  const Result help = gate("VOLUME=0", "--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.output, HasSubstr("Exit code: 0 pass, 1 regression"));
  EXPECT_EQ(folder.read("calls"), "");
}

TEST_F(Ci, ABuildNeedsAPreset) {
  const Result refused = run("", "ci/build");
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.output, HasSubstr("ci/build PRESET"));
}

}  // namespace
}  // namespace triptych::command_line
