// Tests an installation as users get it: its version, its baselines and its shell completion.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "program.hpp"
#include "tree.hpp"

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

TEST_F(Installed, PrintsVersionAndCommit) {
  const Result version = run("triptych --version");
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.output,
              MatchesRegex("triptych [0-9.]+(, commit [0-9a-f]+\\+?)?, device code [0-9a-f]+\n"));
}

// The Debian package is created from the installed files, so their access rights must not depend on
// the umask.
TEST_F(Installed, FilesAreReadableByAllAndWritableByTheOwner) {
  for (const char* umask : {"000", "022"}) {
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
    for (const char* program :
         {"bin/triptych", "share/triptych/analysis/analyze", "share/triptych/analysis/rays"}) {
      EXPECT_EQ(test::run_command("test -x '" + to + "/" + program + "'").code, 0) << program;
    }
  }
}

// The gate must look for baselines in the installed folder. Here, the installed baselines of
// volume/quick are deleted, so the message must name that folder.
TEST_F(Installed, UsesTheInstalledBaselines) {
  const std::string kept = prefix() + "/share/triptych/baselines";
  ASSERT_TRUE(std::filesystem::exists(kept + "/volume/cost/manifest.json"));
  std::filesystem::remove_all(kept + "/volume/quick");
  const std::string scene = std::string(" volume/quick --store s.sqlite ") + tiny;
  const Result judged = run("export TRIPTYCH_NULL_SCRIPT='{}'; triptych run" + scene +
                            " && triptych gate --check counters --json" + scene);
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr("no baselines in " + kept + "/volume/quick"));
}

// Every link in the installed documentation must lead to a file that is also installed.
TEST_F(Installed, ContainsTheCompleteDocumentation) {
  const std::filesystem::path documents = prefix() + "/share/doc/triptych";
  const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  std::size_t links = 0;
  for (const auto& [name, text] : tree(documents)) {
    if (!name.ends_with(".md")) continue;
    for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
      const auto target = documents / std::filesystem::path(name).parent_path() / (*at)[1].str();
      EXPECT_TRUE(std::filesystem::exists(target)) << name << ": " << (*at)[1];
      ++links;
    }
  }
  EXPECT_GT(links, 100U);
}

// The first `accept` creates the user's own baselines, which are used from then on. The installed
// baselines must not change, because several users may share an installation, and changes inside a
// container would be lost.
TEST_F(Installed, AcceptWritesOnlyToTheWorkingDirectory) {
  const std::filesystem::path installed = prefix() + "/share/triptych/baselines";
  const auto before = tree(installed);
  const std::string scene = std::string(" volume/quick --store s.sqlite ") + tiny;
  const std::string device = "export TRIPTYCH_NULL_SCRIPT='{}'; ";
  const Result refused =
      run("mkdir repository && cd repository && " + device + "triptych run" + scene +
          " --inject coarse_filter; triptych accept --store s.sqlite "
          "--reason new");
  EXPECT_EQ(refused.code, 3) << refused.output;
  EXPECT_TRUE(tree(folder.path() / "repository/baselines").empty());
  const Result accepted = run("cd repository && " + device + "triptych run" + scene +
                              " && triptych accept --store s.sqlite --drop --reason new");
  EXPECT_EQ(accepted.code, 0) << accepted.output;
  EXPECT_THAT(accepted.output,
              HasSubstr("baselines was created as a copy of " + installed.string()));
  EXPECT_TRUE(tree(installed) == before);
  auto own = tree(folder.path() / "repository/baselines");
  EXPECT_EQ(own.at("volume/cost/manifest.json"), before.at("volume/cost/manifest.json"));
  EXPECT_NE(own.at("volume/quick/manifest.json"), before.at("volume/quick/manifest.json"));
  const Result judged =
      run("cd repository && " + device + "triptych gate --check counters" + scene);
  EXPECT_EQ(judged.code, 0) << judged.output;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "repository/.baselines.starting"));
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

TEST_F(Installed, TheManualContainsEveryOption) {
  const std::string manual = folder.read("usr/share/man/man1/triptych.1");
  for (const char* text : {".SS \\&gate\n", ".B \\&\\-\\-measure\n", ".B \\&\\-\\-store VALUE\n",
                           "3 usage or I/O", "TRIPTYCH_DATA"}) {
    EXPECT_THAT(manual, HasSubstr(text));
  }
}

}  // namespace
}  // namespace triptych::command_line
