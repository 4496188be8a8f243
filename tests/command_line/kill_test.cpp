// Kills the program at random moments, which are the same in every test run. Stored records must
// remain, and a file or folder must be replaced either completely or not at all. Each command is
// killed 8 times, or as often as TRIPTYCH_KILLS states.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "core/random.hpp"
#include "correct_image.hpp"
#include "killed.hpp"
#include "program.hpp"
#include "record/store.hpp"
#include "tree.hpp"

namespace triptych::command_line {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using testing::HasSubstr;

int kills() {
  const char* variable = std::getenv("TRIPTYCH_KILLS");
  return variable == nullptr ? 8 : std::stoi(variable);
}

Words words_of(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

class Kill : public testing::Test {
 protected:
  const std::string volume =
      "volume/quick --device null:scripted --set technique=raycast --set "
      "data=generate:gaussian_blob:16 --set transfer_function=haze --set "
      "viewport=16";

  // Returns the script of a device that draws the correct image in frames of `base_us`
  // microseconds.
  [[nodiscard]] std::string script(int base_us = 100) const {
    return fmt::format(R"({{"images": {{"*": "{}"}}, "base_ns": {}}})", image_file.string(),
                       1000 * base_us);
  }

  // Runs the command once until it ends. Then starts it repeatedly and kills it each time. Before
  // each start, `before` prepares the folder; after the kill, `check` examines the resulting files.
  template <typename Before, typename Check>
  void kill_repeatedly(const Words& command, const Before& before, const Check& check) {
    before();
    const Ending whole = run_killed(program.folder(), script(), command, "told");
    if (!whole.traced) GTEST_SKIP() << "tracing child processes is not permitted on this machine";
    core::Random random(29);
    for (int i = 0; i < kills() && !HasFailure(); ++i) {
      before();
      // Every second kill is near the end, where files and folders are replaced.
      const double from = i % 2 == 0 ? 0 : 0.9;
      const auto at =
          1 + static_cast<long>(random.uniform(from, 1) * static_cast<double>(whole.calls));
      SCOPED_TRACE(fmt::format("kill {} at {} of {}", i, at, whole.calls));
      static_cast<void>(run_killed(program.folder(), script(), command, "told", at));
      check();
    }
  }

  void remove_store(const std::string& name) const {
    for (const char* part : {"", "-wal", "-shm"}) fs::remove(program.folder() / (name + part));
  }
  void measure(const std::string& store, int base_us) const {
    const Result result = program.run("run " + volume + " --store " + store, script(base_us));
    ASSERT_EQ(result.code, 0) << result.output;
  }

  Program program;
  fs::path image_file = correct_image(program);
};

// The line "3/8 null:scripted …" is printed after the configuration was stored.
TEST_F(Kill, ARunLosesNothingThatItReported) {
  const std::string run =
      "run " + volume + " --verbose --set step=0.5,1 --set ert=0,0.002 --store s.sqlite";
  kill_repeatedly(
      words_of(run), [&] { remove_store("s.sqlite"); },
      [&] {
        const std::string printed = program.read("told");
        std::size_t lines = 0;
        for (std::size_t at = 0; (at = printed.find(" null:scripted ", at)) != std::string::npos;
             ++at)
          ++lines;
        if (fs::exists(program.folder() / "s.sqlite") && lines > 0) {
          const record::Store store(program.folder() / "s.sqlite", record::Store::Mode::append);
          EXPECT_NO_THROW(store.require_whole());
          const auto last = store.latest_run("volume/quick");
          ASSERT_TRUE(last) << printed;
          EXPECT_GE(store.records(last->id).size(), lines) << printed;
        }
        const Result resumed = program.run(run + " --resume", script());
        EXPECT_EQ(resumed.code, 0) << resumed.output;
        EXPECT_THAT(resumed.output, HasSubstr(" 0 skipped, 0 failed"));
      });
}

TEST_F(Kill, AnAcceptIsAllOrNothing) {
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
  ASSERT_NE(before, after);
  kill_repeatedly(
      words_of(accept + "new.sqlite"),
      [&] {
        fs::remove_all(baselines);
        fs::copy(program.folder() / "kept", baselines, fs::copy_options::recursive);
      },
      [&] {
        const auto left = tree(plan);
        EXPECT_TRUE(left == before || left == after);
        const Result again = program.run(accept + "new.sqlite", script());
        EXPECT_EQ(again.code, 0) << again.output;
        EXPECT_TRUE(tree(plan) == after || left == after);
      });
}

TEST_F(Kill, AKilledGateChangesNoVerdict) {
  measure("s.sqlite", 100);
  const std::string given = " --store s.sqlite --baselines b";
  ASSERT_EQ(program.run("accept volume/quick --reason x" + given, script()).code, 0);
  const auto before = tree(program.folder() / "b");
  const std::string gate = "gate " + volume + given;
  ASSERT_EQ(program.run(gate, script()).code, 0);
  fs::copy(program.folder() / "s.sqlite", program.folder() / "kept.sqlite");
  kill_repeatedly(
      words_of(gate + " --out out"),
      [&] {
        remove_store("s.sqlite");
        fs::copy(program.folder() / "kept.sqlite", program.folder() / "s.sqlite");
      },
      [&] {
        EXPECT_TRUE(tree(program.folder() / "b") == before);
        const std::string page = program.read("out/report.html");
        EXPECT_TRUE(page.empty() || page.find("</html>") != std::string::npos);
        const Result judged = program.run(gate, script());
        EXPECT_EQ(judged.code, 0) << judged.output;
      });
}

TEST_F(Kill, AReportIsCompleteOrAbsent) {
  measure("s.sqlite", 100);
  kill_repeatedly(
      words_of("report --store s.sqlite --out r.html --baselines none"),
      [&] { fs::remove(program.folder() / "r.html"); },
      [&] {
        if (!fs::exists(program.folder() / "r.html")) return;
        EXPECT_THAT(program.read("r.html"), HasSubstr("</html>"));
      });
}

// The worker is killed at a system call with a given number, while it draws the frames that follow
// the first configuration.
TEST_F(Kill, AKilledWorkerLosesAtMostOneConfiguration) {
  program.write("kill_worker.sh", R"(delay=$1; shift
"$@" >told 2>&1 &
run=$!
for i in $(seq 600); do grep -q ' null:scripted .*: ' told && break; sleep 0.1; done
sleep "$delay"
worker=$(cat "/proc/$run/task/$run/children") && kill -KILL $worker
wait $run; code=$?
cat told; exit $code
)");
  core::Random random(30);
  for (int i = 0; i < std::min(kills(), 100) / 4; ++i) {
    remove_store("s.sqlite");
    const std::string delay = fmt::format("{:.2f}", random.uniform(0, 0.5));
    const Result result = program.run(
        "run " + volume + " --verbose --set step=0.5,1 --set ert=0,0.002 --store s.sqlite",
        R"({"base_ns": 10000000, "sleep": true})", "sh kill_worker.sh " + delay);
    SCOPED_TRACE(delay + result.output);
    EXPECT_EQ(result.code, 0);
    const auto is_printed = [&](const char* what) {
      return result.output.find(what) != std::string::npos;
    };
    EXPECT_TRUE(is_printed("4 measured, 0 skipped, 0 failed") ||
                (is_printed("3 measured, 0 skipped, 1 failed") && is_printed("killed by SIGKILL")));
  }
}

}  // namespace
}  // namespace triptych::command_line
