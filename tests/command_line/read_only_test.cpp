// Tests that a read-only store, such as a CI artifact or the store of another user, can still be
// judged.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

using std::filesystem::perms;

constexpr perms readable = perms::owner_read | perms::group_read | perms::others_read;
constexpr perms searchable = readable | perms::owner_exec | perms::group_exec | perms::others_exec;

class ReadOnly : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(program.folder() / "kept");
    std::filesystem::create_directory(program.folder() / "own");
    std::filesystem::permissions(program.folder(), perms::all);
    std::filesystem::permissions(program.folder() / "own", perms::all);
    const std::string script = R"({"images": {"*": ")" + correct_image(program).string() + R"("}})";
    ASSERT_EQ(
        program.run(fmt::format("run volume/quick --store kept/s.sqlite {}", tiny), script).code,
        0);
    std::filesystem::permissions(program.folder() / "kept/s.sqlite", readable);
    std::filesystem::permissions(program.folder() / "kept", searchable);
  }
  void TearDown() override { std::filesystem::permissions(program.folder() / "kept", perms::all); }

  // Runs the program as a user who is subject to file permissions.
  [[nodiscard]] Result run(const std::string& arguments) const {
    return program.run(
        arguments, "{}",
        ::geteuid() == 0 ? "setpriv --reuid 65534 --regid 65534 --clear-groups" : "");
  }

  Program program;
};

TEST_F(ReadOnly, StoreCanBeAccepted) {
  const Result accepted =
      run("accept volume/quick --reason new --store kept/s.sqlite --baselines own/b");
  EXPECT_EQ(accepted.code, 0) << accepted.output;
  const Result judged = run(fmt::format(
      "gate volume/quick --store kept/s.sqlite --baselines own/b --junit own/j.xml {}", tiny));
  EXPECT_EQ(judged.code, 0) << judged.output;
}

TEST_F(ReadOnly, StoreCanBeReported) {
  const Result reported = run("report --store kept/s.sqlite --out own/page.html --baselines own/b");
  EXPECT_EQ(reported.code, 0) << reported.output;
  EXPECT_NE(program.read("own/page.html").find("the reference image"), std::string::npos);
}

// SQLite can open a writable file in a read-only folder, but cannot change it, because it cannot
// create a journal in the folder.
TEST_F(ReadOnly, AReadOnlyFolderIsEnoughToJudge) {
  std::filesystem::permissions(program.folder() / "kept/s.sqlite",
                               readable | perms::owner_write | perms::others_write);
  const Result judged = run("gate volume/quick --store kept/s.sqlite --baselines own/b");
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_NE(judged.output.find("there are no baselines"), std::string::npos) << judged.output;
  EXPECT_EQ(judged.output.find("no reference image"), std::string::npos) << judged.output;
}

TEST_F(ReadOnly, StoreRejectsNewRuns) {
  const Result measured = run(fmt::format("run volume/quick --store kept/s.sqlite {}", tiny));
  EXPECT_EQ(measured.code, 3) << measured.output;
}

}  // namespace
}  // namespace triptych::command_line
