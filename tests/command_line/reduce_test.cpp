// Tests `triptych reduce` with frames that fail on a scripted device.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string scene = "reduce volume --device null:scripted --out r ";

std::string failing(const std::string& kind, const std::string& only) {
  return fmt::format(
      R"({{"base_ns": 1e5, "failures": [{{"kind": "{}", "at": "frame", "only": "{}"}}]}})", kind,
      only);
}

// Returns the last line without the name of the program.
std::string last_command(const std::string& output) {
  constexpr std::string_view program = "\ntriptych ";
  const std::size_t begin = output.rfind(program);
  if (begin == std::string::npos) return {};
  const std::size_t first = begin + program.size();
  return output.substr(first, output.find('\n', first) - first);
}

TEST(Reduce, ACrashIsReducedToWhatItRequires) {
  const Program program;
  const std::string crash = failing("crash", "*step=0.5,*skip=distance*");
  const Result result = program.run(scene + "--set step=0.5 --set viewport=64", crash);
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("crashed: "));
  EXPECT_THAT(result.output, HasSubstr("viewport 64 → 1"));
  EXPECT_THAT(result.output, HasSubstr("data generate:mandelbulb:96 → generate:mandelbulb:1,"));
  const std::string command = last_command(result.output);
  EXPECT_THAT(command, HasSubstr("--set step=0.5"));
  EXPECT_THAT(command, Not(HasSubstr("--set skip")));  // the level is already the default
  const Result again = program.run(command, crash);
  EXPECT_EQ(again.code, 3) << again.output;
  EXPECT_THAT(again.output, HasSubstr("SIGABRT"));
}

// Otherwise, users would not notice that a command used another driver than the finding.
TEST(Reduce, TheDriverIsPrintedByEveryCommandThatDraws) {
  const Program program;
  const std::string drawn = "volume --device null:scripted --set viewport=8 --out f";
  for (const std::string command :
       {"render ", "render --in-process ", "render --inject crash ", "reduce "}) {
    EXPECT_THAT(program.run(command + drawn).output, ContainsRegex("null:scripted(:| [(])"))
        << command;
  }
}

TEST(Reduce, TheFolderContainsEverythingForABugReport) {
  const Program program;
  const Result result = program.run(scene + "--set viewport=8", failing("crash", "none"));
  // The scripted device draws a pattern, which is not the correct image.
  ASSERT_EQ(result.code, 1) << result.output;
  EXPECT_THAT(result.output,
              HasSubstr("1 of 1 pixels exceed the error bound of the reference image"));
  for (const char* file : {"image.exr", "image.png", "truth.exr", "truth.png", "difference.png"}) {
    EXPECT_TRUE(std::filesystem::exists(program.folder() / "r" / file)) << file;
  }
  const std::string text = program.read("r/README.md");
  EXPECT_THAT(text, HasSubstr("# A frame that null:scripted draws incorrectly"));
  EXPECT_THAT(text, HasSubstr("| viewport | 1 |"));
  EXPECT_THAT(text, HasSubstr("triptych render volume --device null:scripted"));
  EXPECT_THAT(
      text,
      HasSubstr("If any factor is simplified further, the frame no longer fails in this way."));
  EXPECT_THAT(program.read("r/frame.json"), HasSubstr("transfer_function"));
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "r/.reduce.sqlite"));
  const Result again = program.run(last_command(result.output), failing("crash", "none"));
  EXPECT_EQ(again.code, 1) << again.output;
}

// If files of an earlier frame stayed in the folder, images of another scene would become part of
// the bug report.
TEST(Reduce, FilesOfAnEarlierFrameAreRemoved) {
  const Program program;
  ASSERT_EQ(program.run(scene + "--set viewport=8", failing("crash", "none")).code, 1);
  EXPECT_TRUE(std::filesystem::exists(program.folder() / "r/difference.png"));
  ASSERT_EQ(program.run(scene + "--set viewport=8", failing("crash", "*")).code, 1);
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "r/image.png"));
  EXPECT_TRUE(std::filesystem::exists(program.folder() / "r/truth.png"));
}

// If the user replaces `render` with `reduce` in a command, both commands name the same folder.
TEST(Reduce, FilesOfRenderAreNotMixedWithThoseOfReduce) {
  const Program program;
  const std::string drawn = "volume --device null:scripted --out r --set viewport=8";
  ASSERT_EQ(program.run("render --truth " + drawn).code, 1);
  const std::string frame = program.read("r/frame.json");
  const Result result = program.run("reduce " + drawn);
  ASSERT_EQ(result.code, 1) << result.output;
  EXPECT_EQ(program.read("r/frame.json"), frame);
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "r/README.md"));
  EXPECT_THAT(program.read("r/reduced/README.md"), HasSubstr("| viewport | 1 |"));
  EXPECT_THAT(result.output, HasSubstr("r/reduced/README.md"));
}

// The title must state how the frame fails, and that the driver is not at fault.
TEST(Reduce, TheTitleStatesTheFailureAndTheInjectedFault) {
  const Program program;
  const auto title_with = [&](const std::string& options) {
    const Result result = program.run(scene + "--set viewport=8 --limit 1 --frames 2 " + options);
    EXPECT_EQ(result.code, 1) << result.output;
    const std::string text = program.read("r/README.md");
    return text.substr(0, text.find('\n'));
  };
  EXPECT_THAT(title_with("--inject crash"), HasSubstr("crashes on null:scripted"));
  EXPECT_THAT(title_with("--inject hang"),
              AllOf(HasSubstr("hangs on null:scripted"), HasSubstr("injected fault")));
  EXPECT_THAT(title_with(""), Not(HasSubstr("injected fault")));
}

TEST(Reduce, AHangIsReducedWithinItsTimeLimit) {
  const Program program;
  const Result result =
      program.run(scene + "--set viewport=2 --limit 1", failing("hang", "*width=2,*"));
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("hung: no answer within 1 s"));
  EXPECT_THAT(result.output, HasSubstr("viewport 2 → 2x1"));
}

TEST(Reduce, AFrameThatDoesNotFailPasses) {
  const Program program;
  const std::string script = fmt::format(R"({{"images": {{"*": "{}"}}, "base_ns": 1e5}})",
                                         correct_image(program).string());
  const Result result =
      program.run(std::string("reduce volume --out r --set step=0.5 ") + tiny, script);
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(result.output,
              HasSubstr("the frame does not fail on null:scripted, so there is nothing to reduce; "
                        "if it failed in a plan, add --after PLAN\n"));
}

// A frame that crashes only if two other configurations were drawn before it in the same process.
class ReduceAfter : public ::testing::Test {
 protected:
  void SetUp() override {
    program_.write("order.yaml", R"(
suite: volume
summary: Eight levels of one factor
technique: [raycast]
data: [generate:gaussian_blob:16]
transfer_function: [haze]
viewport: [16]
step: [0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 1]
)");
  }

  Result reduce(const std::string& after, const std::string& more = "") {
    const std::string script = fmt::format(
        R"({{"images": {{"*": "{}"}}, "base_ns": 1e5, "failures": [
            {{"kind": "crash", "at": "frame", "only": "*step=0.5,*", "after": [{}]}}]}})",
        correct_image(program_).string(), after);
    script_ = script;
    return program_.run(
        fmt::format("reduce volume --out r --set step=0.5 {} --after order.yaml {}", tiny, more),
        script);
  }

  Program program_;
  std::string script_;
};

TEST_F(ReduceAfter, TheShortestSequenceIsFoundAndReproduced) {
  const Result result = reduce(R"("*step=0.25,*", "*step=0.4,*")");
  ASSERT_EQ(result.code, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("the frame fails after 2 of 6 configurations:"));
  const std::string list = program_.read("r/sequence.txt");
  EXPECT_EQ(std::ranges::count(list, '\n'), 3) << list;
  EXPECT_LT(list.find("step=0.25,"), list.find("step=0.4,"));
  EXPECT_LT(list.find("step=0.4,"), list.find("step=0.5,"));
  EXPECT_THAT(program_.read("r/README.md"), HasSubstr("## The configurations before the frame"));
  const Result again = program_.run(last_command(result.output), script_);
  EXPECT_THAT(again.output, HasSubstr("SIGABRT"));
}

TEST_F(ReduceAfter, ConfigurationsAfterTheFrameAreNotDrawn) {
  const Result result = reduce(R"("*step=1,*")");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("neither alone nor after the 6 configurations"));
}

TEST_F(ReduceAfter, ALimitedSearchTriesTheWholeListAndSaysThatItIsIncomplete) {
  const Result result = reduce(R"("*step=0.2,*")", "--frames 3");
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("the search stopped at the limit set by --frames"));
}

TEST_F(ReduceAfter, APlanWithoutTheFrameIsRejected) {
  program_.write("order.yaml", tiny_plan);
  const Result result = reduce(R"("*")");
  EXPECT_EQ(result.code, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("--after order.yaml"));
}

TEST(Reduce, ReachingTheFrameLimitIsReported) {
  const Program program;
  const Result result = program.run(scene + "--frames 1", failing("crash", "none"));
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("1 frames drawn; "));
  EXPECT_THAT(result.output, HasSubstr("the search stopped at the limit set by --frames"));
}

TEST(Reduce, UndrawableConfigurationsAreRejected) {
  const Program program;
  const Result result = program.run(scene, failing("not_supported", "*"));
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_EQ(program.run(scene + "--set step=0.5,1").code, 3);
  EXPECT_EQ(program.run(scene + "--set data=gone.nrrd").code, 3);
}

}  // namespace
}  // namespace triptych::command_line
