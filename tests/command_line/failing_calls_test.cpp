// Tests how the commands run, accept, merge and gate react to a system call that fails. A command
// must either exit with 0 and have written everything, or exit with another code and a line that
// names the failure. It must never leave a half-written baseline. By default, each command is
// repeated about 12 times. In each repetition, a single system call fails. These calls are spread
// evenly over all calls that the command makes. TRIPTYCH_KILLS=N sets the number of repetitions.

#include "failing_calls.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "correct_image.hpp"
#include "program.hpp"
#include "record/merge/merge.hpp"
#include "record/store.hpp"
#include "tree.hpp"

namespace triptych::command_line {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;

long tries() {
  const char* variable = std::getenv("TRIPTYCH_KILLS");
  return variable == nullptr ? 12 : std::stol(variable);
}

class FailingCalls : public testing::Test {
 protected:
  const std::string volume =
      "volume/quick --device null:scripted --set technique=raycast --set "
      "data=generate:gaussian_blob:16 --set transfer_function=haze --set viewport=16";

  [[nodiscard]] std::string script(int base_us = 100) const {
    return fmt::format(R"({{"images": {{"*": "{}"}}, "base_ns": {}}})", image_file.string(),
                       1000 * base_us);
  }

  // `before` prepares the folder. `check` receives the exit code and examines the resulting files.
  template <typename Before, typename Check>
  void fail_repeatedly(const std::string& command, const Before& before, const Check& check) {
    std::istringstream in(command);
    const std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
    before();
    const Outcome whole = run_failing(program.folder(), script(), words, "told");
    if (!whole.traced) GTEST_SKIP() << "tracing child processes is not permitted on this machine";
    ASSERT_EQ(whole.code, 0) << program.read("told");
    ASSERT_GT(whole.calls, 0);
    const long step = std::max(1L, whole.calls / tries());
    for (long at = 1; at <= whole.calls && !HasFailure(); at += step) {
      before();
      const Outcome outcome = run_failing(program.folder(), script(), words, "told", at);
      const std::string printed = program.read("told");
      SCOPED_TRACE(fmt::format("call {} of {}: {}", at, whole.calls, printed));
      EXPECT_THAT(outcome.code, AnyOf(0, 2, 3));
      if (outcome.code != 0) {
        EXPECT_NE(printed, "");
      }
      check(outcome.code);
    }
  }

  void remove_store(const std::string& name) const {
    for (const char* part : {"", "-wal", "-shm"}) fs::remove(program.folder() / (name + part));
  }
  void measure(const std::string& store, int base_us = 100) const {
    const Result result = program.run("run " + volume + " --store " + store, script(base_us));
    ASSERT_EQ(result.code, 0) << result.output;
  }

  Program program;
  fs::path image_file = correct_image(program);
};

TEST_F(FailingCalls, ARunIsCompleteOrReportsThatItIsNot) {
  fail_repeatedly(
      "run " + volume + " --store s.sqlite", [&] { remove_store("s.sqlite"); },
      [&](int code) {
        if (code == 0) {
          const record::Store store(program.folder() / "s.sqlite", record::Store::Mode::read);
          EXPECT_TRUE(record::gaps_of(store).empty());
        }
        const Result resumed =
            program.run("run " + volume + " --store s.sqlite --resume", script());
        EXPECT_EQ(resumed.code, 0) << resumed.output;
      });
}

TEST_F(FailingCalls, AnAcceptIsAllOrNothing) {
  measure("old.sqlite", 100);
  measure("new.sqlite", 200);
  const std::string accept = "accept volume/quick --reason x --baselines b --store ";
  ASSERT_EQ(program.run(accept + "old.sqlite", script()).code, 0);
  const fs::path baselines = program.folder() / "b";
  const fs::path plan = baselines / "volume/quick";
  const auto before = tree(plan);
  fs::copy(baselines, program.folder() / "kept", fs::copy_options::recursive);
  ASSERT_EQ(program.run(accept + "new.sqlite", script()).code, 0);
  const auto after = tree(plan);
  fail_repeatedly(
      accept + "new.sqlite",
      [&] {
        fs::remove_all(baselines);
        fs::copy(program.folder() / "kept", baselines, fs::copy_options::recursive);
      },
      [&](int code) {
        const auto left = tree(plan);
        EXPECT_TRUE(left == after || (code != 0 && left == before));
      });
}

TEST_F(FailingCalls, AMergeIsCompleteOrAbsent) {
  measure("a.sqlite");
  measure("b.sqlite");
  fail_repeatedly(
      "merge a.sqlite b.sqlite --out m.sqlite", [&] { remove_store("m.sqlite"); },
      [&](int code) {
        const bool there = fs::exists(program.folder() / "m.sqlite");
        if (code == 0) {
          EXPECT_TRUE(there);
        }
        if (!there) return;
        // The store may exist despite an error only if it is complete and its summary could not be
        // printed.
        if (code != 0) {
          EXPECT_THAT(program.read("told"), testing::HasSubstr("standard output"));
        }
        const record::Store store(program.folder() / "m.sqlite", record::Store::Mode::read);
        store.require_whole();
        EXPECT_TRUE(record::gaps_of(store).empty());
      });
}

TEST_F(FailingCalls, APassingGateHasWrittenEverything) {
  measure("s.sqlite");
  const std::string given = " --store s.sqlite --baselines b";
  ASSERT_EQ(program.run("accept volume/quick --reason x" + given, script()).code, 0);
  const auto baselines = tree(program.folder() / "b");
  fail_repeatedly(
      "gate " + volume + given + " --out out", [&] { fs::remove_all(program.folder() / "out"); },
      [&](int code) {
        EXPECT_TRUE(tree(program.folder() / "b") == baselines);
        if (code != 0) return;
        EXPECT_THAT(program.read("out/report.html"), testing::HasSubstr("</html>"));
        EXPECT_NE(program.read("out/gate.log"), "");
      });
}

}  // namespace
}  // namespace triptych::command_line
