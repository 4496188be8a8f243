// Tests `triptych reduce` with frames that fail on a scripted device.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "program.hpp"
#include "right_picture.hpp"

namespace triptych::command_line {
namespace {

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
  const std::string render = "render volume --device null:scripted --truth --out r --set viewport=";
  ASSERT_EQ(program.run(render + "8").code, 1);
  EXPECT_TRUE(std::filesystem::exists(program.folder() / "r/difference.png"));
  EXPECT_EQ(program.run(render + "4", failing("crash", "*")).code, 3);
  EXPECT_TRUE(std::filesystem::is_empty(program.folder() / "r"));
  ASSERT_EQ(program.run(scene + "--set viewport=8", failing("crash", "none")).code, 1);
  ASSERT_EQ(program.run(scene + "--set viewport=8", failing("crash", "*")).code, 1);
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "r/image.png"));
  EXPECT_TRUE(std::filesystem::exists(program.folder() / "r/truth.png"));
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
                                         right_picture(program).string());
  const Result result =
      program.run(std::string("reduce volume --out r --set step=0.5 ") + tiny, script);
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_EQ(result.output,
            "the frame does not fail on null:scripted, so there is nothing to reduce\n");
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
