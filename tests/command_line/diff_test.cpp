// Compares two stores, from before and after a driver update.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

using ::testing::HasSubstr;

class Diff : public testing::Test {
 protected:
  void measure(const std::string& store, const std::string& keys = "",
               const std::string& plan = "volume/quick") const {
    const std::string script =
        fmt::format(R"({{"images": {{"*": "{}"}}, "base_ns": 1e5{}}})", image_file.string(), keys);
    const Result result = program.run(
        fmt::format("run {} --untimed --set skip=none,bricks --store {} {}", plan, store, tiny),
        script);
    ASSERT_EQ(result.code, 0) << result.output;
  }
  [[nodiscard]] Result diff(const std::string& more = "") const {
    return program.run("diff old.sqlite new.sqlite " + more);
  }

  Program program;
  std::filesystem::path image_file = correct_image(program);
};

TEST_F(Diff, TheSameDriverShowsNoDifference) {
  measure("old.sqlite");
  measure("new.sqlite");
  const Result result = diff();
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("null:scripted, 2 configurations"));
  EXPECT_THAT(result.output, HasSubstr("no differences"));
}

TEST_F(Diff, NewAndFixedFailuresAreReported) {
  measure("old.sqlite");
  measure("new.sqlite", R"(, "failures": [{"kind": "wrong_image", "at": "image"}])");
  const Result worse = diff();
  EXPECT_EQ(worse.code, 1) << worse.output;
  EXPECT_THAT(worse.output, HasSubstr("regression    image: "));
  EXPECT_THAT(worse.output, HasSubstr("2 configurations"));
  const Result better = program.run("diff new.sqlite old.sqlite --json");
  EXPECT_EQ(better.code, 0) << better.output;
  EXPECT_THAT(better.output, HasSubstr(R"("kind": "fixed")"));
}

TEST_F(Diff, InjectedFaultsAreNotAttributedToADriver) {
  measure("old.sqlite");
  const std::string script = fmt::format(R"({{"images": {{"*": "{}"}}}})", image_file.string());
  const std::string run = std::string("run volume/quick --untimed --store new.sqlite ") + tiny +
                          " --set skip=none,bricks --inject 'crash@*skip=bricks*'";
  static_cast<void>(program.run(run, script));
  const Result result = diff();
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr(" [injected: crash]\n"));
  EXPECT_THAT(diff("--json").output, HasSubstr(" [injected: crash]\""));
}

TEST_F(Diff, APlanInOnlyOneStoreCannotBeJudged) {
  measure("old.sqlite");
  measure("new.sqlite");
  measure("new.sqlite", "", "volume/accuracy");
  const Result result = diff();
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_THAT(result.output, HasSubstr("plan volume/accuracy exists only on side b"));
}

// The driver could draw nothing before the update and nothing after it. That must not count as a
// pass.
TEST_F(Diff, NothingMeasuredCannotBeJudged) {
  for (const char* store : {"old.sqlite", "new.sqlite"}) {
    const Result run =
        program.run(fmt::format("run volume/quick --untimed --store {} {}", store, tiny),
                    R"({"failures": [{"kind": "not_supported", "at": "frame", "only": "*"}]})");
    ASSERT_EQ(run.code, 2) << run.output;
  }
  const Result result = diff();
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_THAT(result.output, HasSubstr("nothing was compared: no configuration was measured"));
}

TEST_F(Diff, OnlySelectedDevicesAreCompared) {
  measure("old.sqlite");
  measure("new.sqlite");
  const Result result = diff("--device 'gl:*'");
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_EQ(result.output,
            "triptych: neither old.sqlite nor new.sqlite contains a run on a matching device\n");
}

TEST_F(Diff, AMissingStoreIsReported) {
  measure("old.sqlite");
  EXPECT_THAT(diff().output, HasSubstr("new.sqlite"));
  EXPECT_THAT(diff().code, ::testing::AnyOf(2, 3));
}

}  // namespace
}  // namespace triptych::command_line
