// Tests that shards that are measured separately and then merged are judged like a run on a single
// machine.

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "core/file.hpp"
#include "killed.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class MergeCommand : public testing::Test {
 protected:
  MergeCommand() {
    program.write("p.yaml",
                  std::string(tiny_plan) +
                      "checks: [counters, statistics]\n"
                      "step: [0.5, 0.7]\ncamera: [random:1, random:2, random:3, random:4]\n");
    for (int i = 1; i <= 3; ++i) {
      const std::string number = std::to_string(i);
      const Result measured = run("run p.yaml --device 'null:*' --store " + number +
                                  ".sqlite --shard " + number + "/3");
      EXPECT_EQ(measured.code, 0) << measured.output;
    }
  }
  [[nodiscard]] Result run(const std::string& arguments) const {
    return program.run(arguments, R"({"devices": [1, 2]})");
  }
  // Returns the gate's verdict without the times and file names of the run.
  [[nodiscard]] std::string verdict_on(const std::string& store) const {
    const Result judged = run("gate p.yaml --baselines b --json --store " + store);
    return std::to_string(judged.code) +
           std::regex_replace(judged.output, std::regex(store + "|\"run\": \"[^\"]*\"|[0-9.]+ ms"),
                              "");
  }
  const Program program;
};

TEST_F(MergeCommand, ResultIsJudgedAsOneRun) {
  ASSERT_EQ(run("run p.yaml --device 'null:*' --store whole.sqlite").code, 0);
  const Result merged = run("merge 3.sqlite 1.sqlite 2.sqlite --out m.sqlite");
  EXPECT_EQ(merged.code, 0) << merged.output;
  EXPECT_THAT(merged.output, AllOf(HasSubstr(" in m.sqlite: 8 configurations\n"),
                                   HasSubstr("  null:scripted: 8 records\n"
                                             "  null:scripted#2: 8 records\n")));
  const Result accepted = run("accept p.yaml --reason x --baselines b --store m.sqlite");
  EXPECT_EQ(accepted.code, 0) << accepted.output;
  EXPECT_THAT(verdict_on("m.sqlite"), testing::StartsWith("0"));
  EXPECT_EQ(verdict_on("m.sqlite"), verdict_on("whole.sqlite"));
  EXPECT_EQ(run("report --store m.sqlite --out r.html --baselines b").code, 0);
  EXPECT_THAT(run("run p.yaml --device 'null:*' --resume --store m.sqlite").output,
              HasSubstr("16 of these results were already in the store"));
}

TEST_F(MergeCommand, AMissingShardIsReported) {
  const Result merged = run("merge 1.sqlite 2.sqlite --out m.sqlite");
  EXPECT_EQ(merged.code, 0) << merged.output;
  EXPECT_THAT(run("gate p.yaml --baselines b --store m.sqlite").output,
              HasSubstr("have no record"));
}

// If a shard lacks a configuration on every device, the merged run contains no trace of that
// configuration. Therefore the command itself must report what its inputs lack.
TEST_F(MergeCommand, ReportsWhatItsInputsLack) {
  SQLite::Database((program.folder() / "2.sqlite").string(), SQLite::OPEN_READWRITE)
      .exec("DELETE FROM record WHERE configuration = (SELECT min(configuration) FROM record)");
  const Result merged = run("merge 1.sqlite 2.sqlite 3.sqlite --out m.sqlite");
  EXPECT_EQ(merged.code, 0) << merged.output;
  EXPECT_THAT(merged.output,
              AllOf(HasSubstr(" in m.sqlite: 8 configurations\n"),
                    testing::ContainsRegex(
                        "\n2.sqlite: .* on null:scripted: records for 2 of 3 configurations.*"
                        "\n2.sqlite: .* on null:scripted#2: records for 2 of 3 config"),
                    HasSubstr("\nThe records listed above are also missing from "
                              "m.sqlite unless another store contains them"),
                    Not(HasSubstr("\n1.sqlite")), Not(HasSubstr("\n3.sqlite"))));
  fs::remove(program.folder() / "m.sqlite");
  EXPECT_THAT(run("merge 1.sqlite 3.sqlite --out m.sqlite").output, Not(HasSubstr("also missing")));
}

TEST_F(MergeCommand, ReportsThatInjectedFaultsAreReplaced) {
  ASSERT_EQ(
      run("run p.yaml --device 'null:*' --store 4.sqlite --shard 1/3 --inject lost_counter").code,
      0);
  const Result merged = run("merge 4.sqlite 1.sqlite 2.sqlite 3.sqlite --out m.sqlite");
  EXPECT_EQ(merged.code, 0) << merged.output;
  EXPECT_THAT(
      merged.output,
      HasSubstr("  6 records with an injected fault were replaced by records without one\n"));
  SQLite::Database out((program.folder() / "m.sqlite").string(), SQLite::OPEN_READONLY);
  EXPECT_EQ(out.execAndGet("SELECT count(*) FROM record WHERE injected != ''").getInt(), 0);
}

TEST_F(MergeCommand, CheckReportsIncompleteStores) {
  EXPECT_EQ(run("merge --check 1.sqlite 2.sqlite 3.sqlite --plan p.yaml").code, 0);
  ASSERT_EQ(
      run("run p.yaml --device 'null:*' --resume --set camera=random:1 --store 4.sqlite").code, 0);
  ASSERT_EQ(run("run p.yaml --device null:scripted --set camera=random:1 --store 5.sqlite").code,
            0);
  // A killed run leaves a store like this one, which contains fewer records than were planned.
  ASSERT_EQ(run("run volume/quick --device 'null:*' --store 5.sqlite --shard 90/90").code, 2);
  const Result checked = run("merge --check 4.sqlite 5.sqlite --plan p.yaml --plan volume/quick");
  EXPECT_EQ(checked.code, 2);
  EXPECT_EQ(checked.output, "4.sqlite: volume/quick: no run of this plan\n");
  EXPECT_THAT(run("merge --check none.sqlite").output, HasSubstr("there is no such file"));
}

TEST_F(MergeCommand, WrongUsageIsRejected) {
  EXPECT_THAT(run("merge 1.sqlite").output, HasSubstr("--out is required"));
  EXPECT_THAT(run("merge --check --out x 1.sqlite").output, HasSubstr("excludes"));
  EXPECT_EQ(run("merge 1.sqlite 2.sqlite --out 1.sqlite").code, 3);
  program.write("text", "no store");
  const Result text = run("merge 1.sqlite text --out m.sqlite");
  EXPECT_EQ(text.code, 3);
  EXPECT_THAT(text.output, HasSubstr("text: is not an SQLite file"));
  EXPECT_FALSE(fs::exists(program.folder() / "m.sqlite"));
}

TEST_F(MergeCommand, AKilledMergeLeavesAllOrNothing) {
  const std::vector<std::string> command{"merge", "1.sqlite", "2.sqlite", "--out", "m.sqlite"};
  const Ending whole = run_killed(program.folder(), "{}", command, "told");
  if (!whole.traced) GTEST_SKIP() << "tracing child processes is not permitted on this machine";
  const auto expected = core::read_file(program.folder() / "m.sqlite");
  for (int i = 1; i < 12; ++i) {
    fs::remove(program.folder() / "m.sqlite");
    const Ending ending = run_killed(program.folder(), "{}", command, "told", whole.calls * i / 12);
    SCOPED_TRACE(i);
    if (fs::exists(program.folder() / "m.sqlite")) {
      EXPECT_EQ(core::read_file(program.folder() / "m.sqlite"), expected);
    } else {
      EXPECT_TRUE(ending.killed);
    }
  }
}

}  // namespace
}  // namespace triptych::command_line
