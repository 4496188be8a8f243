// What a user gets who has installed the program: its version, its baselines and its shell
// completion.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

class Installed : public testing::Test {
 protected:
  void SetUp() override {
    const Result done = test::run_command(
        "cmake --install '" TRIPTYCH_BINARY_FOLDER "' --prefix '" + prefix() + "'");
    ASSERT_EQ(done.code, 0) << done.output;
  }

  [[nodiscard]] std::string prefix() const { return (folder.path() / "usr").string(); }
  [[nodiscard]] Result run(const std::string& command) const {
    return test::run_command("cd '" + folder.path().string() +
                             "' && PATH=\"$PWD/usr/bin:$PATH\" && " + command);
  }

  test::TemporaryFolder folder;
};

TEST_F(Installed, NamesVersionAndCommit) {
  const Result version = run("triptych --version");
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.output,
              MatchesRegex("triptych [0-9.]+(, commit [0-9a-f]+\\+?)?, device code [0-9a-f]+\n"));
}

// The package is made from these files.
TEST_F(Installed, NobodyElseCanWriteAndEverybodyCanRead) {
  for (const char* umask : {"000", "077"}) {
    const std::string to = (folder.path() / umask).string();
    ASSERT_EQ(test::run_command(std::string("umask ") + umask + "; cmake --install '" +
                                TRIPTYCH_BINARY_FOLDER "' --prefix '" + to + "'")
                  .code,
              0);
    EXPECT_EQ(test::run_command("find '" + to + "' -mindepth 1 -perm /022").output, "") << umask;
    EXPECT_EQ(test::run_command("find '" + to + "' -mindepth 1 ! -perm -444").output, "") << umask;
    EXPECT_EQ(test::run_command("find '" + to + "' -mindepth 1 -type d ! -perm -111").output, "")
        << umask;
    EXPECT_EQ(test::run_command("find '" + to + "' -perm /6000").output, "") << umask;
    for (const char* program : {"bin/triptych", "share/triptych/analysis/analyze"}) {
      EXPECT_EQ(test::run_command("test -x '" + to + "/" + program + "'").code, 0) << program;
    }
  }
}

// Baselines are found where they were installed, also for plans that were not measured.
TEST_F(Installed, JudgesByTheBaselinesInstalledWithIt) {
  const std::string kept = prefix() + "/share/triptych/baselines";
  ASSERT_TRUE(std::filesystem::exists(kept + "/volume/cost/manifest.json"));
  std::filesystem::remove_all(kept + "/volume/quick");
  const std::string scene = std::string(" volume/quick --store s.sqlite ") + tiny;
  const Result judged = run("export TRIPTYCH_NULL_SCRIPT='{}'; triptych run" + scene +
                            " && triptych gate --check counters --json" + scene);
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr("no baselines in " + kept + "/volume/quick"));
}

TEST_F(Installed, CompletesCommandsOptionsAndPlans) {
  const std::string complete =
      "bash -c '. usr/share/bash-completion/completions/triptych; COMP_WORDS=(triptych gate "
      "\"$1\"); "
      "COMP_CWORD=$2; _triptych triptych \"$1\"; echo ${COMPREPLY[@]}' bash ";
  EXPECT_EQ(run(complete + "ga 1").output, "gate\n");
  EXPECT_EQ(run(complete + "--mea 2").output, "--measure\n");
  EXPECT_EQ(run(complete + "volume/q 2").output, "volume/quick\n");
}

TEST_F(Installed, TheManualNamesEveryOption) {
  const std::string manual = folder.read("usr/share/man/man1/triptych.1");
  for (const char* text : {".SS \\&gate\n", ".B \\&\\-\\-measure\n", ".B \\&\\-\\-store VALUE\n",
                           "3 usage or I/O", "TRIPTYCH_DATA"}) {
    EXPECT_THAT(manual, HasSubstr(text));
  }
}

}  // namespace
}  // namespace triptych::command_line
