// Tests which files `render` writes and keeps, what it prints, and its notes about empty images.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "tree.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

const std::string one_scene =
    "render volume --out r --device 'null:*' --set technique=raycast --set "
    "data=generate:gaussian_blob:16 --set transfer_function=haze ";
const std::string draw_scene = one_scene + "--set viewport=16";

TEST(Render, PrintsItsFilesTheDeviceAndTheTime) {
  const Program program;
  const Result result = program.run(draw_scene);
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(result.output,
              MatchesRegex("r/image.png\nr/image.exr\nr/frame.json\n"
                           "drew 16x16 with null:scripted \\(.+\\) in [0-9.]+ ms \\(median of 8 "
                           "frames, (device|wall) clock\\)\n"));
}

TEST(Render, UntimedFramesHaveAnImageAndCountersButNoTimes) {
  const Program program;
  const Result result = program.run(draw_scene + " --untimed");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(result.output, Not(HasSubstr(" ms ")));
  const auto frame = nlohmann::json::parse(program.read("r/frame.json"));
  EXPECT_TRUE(frame.at("time_ns").at("wall").at("samples").empty());
  EXPECT_TRUE(frame.contains("counters"));
  EXPECT_EQ(program
                .run("render volume --out r --device null:scripted --untimed --set "
                     "technique=auto")
                .code,
            3);
}

class EarlierFrame : public testing::Test {
 protected:
  EarlierFrame() {
    EXPECT_EQ(program.run(draw_scene + " --truth").code, 1);  // the null device draws a black image
    program.write("r/notes.txt", "mine");
    before = tree(program.folder() / "r");
  }

  Program program;
  std::map<std::string, std::string> before;
};

TEST_F(EarlierFrame, IsKeptIfTheNextFrameIsNotDrawn) {
  for (const char* kind : {"crash", "api_error", "not_supported"}) {
    const Result result =
        program.run(draw_scene + " --set step=0.5",
                    fmt::format(R"({{"failures": [{{"kind": "{}", "at": "frame"}}]}})", kind));
    EXPECT_NE(result.code, 0) << kind << result.output;
    EXPECT_TRUE(tree(program.folder() / "r") == before) << kind;
  }
  const Result too_large = program.run(one_scene + "--set viewport=16384");
  EXPECT_EQ(too_large.code, 2) << too_large.output;
  EXPECT_TRUE(tree(program.folder() / "r") == before);
}

TEST_F(EarlierFrame, IsKeptIfRenderIsInterrupted) {
  const Result result = program.run(draw_scene, R"({"failures": [{"kind": "hang", "at": "open"}]})",
                                    "timeout --foreground -s INT 2");
  EXPECT_EQ(result.code, 124) << result.output;
  EXPECT_TRUE(tree(program.folder() / "r") == before);
}

// frame.json cannot be written, because a folder has its name.
TEST_F(EarlierFrame, IsKeptIfOneOfTheNewFilesCannotBeWritten) {
  std::filesystem::remove(program.folder() / "r/frame.json");
  std::filesystem::create_directory(program.folder() / "r/frame.json");
  before = tree(program.folder() / "r");
  const Result result = program.run(one_scene + "--set viewport=8");
  EXPECT_EQ(result.code, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("frame.json: cannot write: Is a directory"));
  EXPECT_TRUE(tree(program.folder() / "r") == before);
}

TEST_F(EarlierFrame, IsReplacedWithItsComparison) {
  EXPECT_EQ(program.run(draw_scene + " --set step=0.5").code, 0);
  for (const char* file : {"truth.exr", "truth.png", "difference.png"}) {
    EXPECT_FALSE(std::filesystem::exists(program.folder() / "r" / file)) << file;
  }
  EXPECT_EQ(program.read("r/notes.txt"), "mine");
  EXPECT_THAT(program.read("r/frame.json"), HasSubstr("\"step\": \"0.5\""));
}

class EmptyImage : public testing::Test {
 protected:
  EmptyImage() {
    program.write("ramp.nrrd", header + std::string("0 10 20 30 40 50 1200 1300\n"));
    program.write("flat.nrrd", header + std::string("7 7 7 7 7 7 7 7\n"));
  }
  static constexpr const char* header =
      "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n";
  const std::string missed = "--set data=ramp.nrrd --set window=5000..10000 ";
  Program program;
};

TEST_F(EmptyImage, IsReportedByEveryCommandThatLoadsTheData) {
  for (const std::string command :
       {"render volume --describe ", "render volume --out r --device null:scripted ",
        "run volume/quick --device null:scripted --set technique=raycast --set step=1 --set "
        "viewport=16 --set transfer_function=haze --set camera=orbit_y:1/8 --store s.sqlite "}) {
    const Result result = program.run(command + missed);
    EXPECT_EQ(result.code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("100 % of the values are below the window 5000..10000"));
    EXPECT_THAT(result.output, HasSubstr("the image is empty"));
  }
}

TEST_F(EmptyImage, IsNotReportedIfAValueIsVisible) {
  const Result result = program.run("render volume --describe --set data=ramp.nrrd");
  EXPECT_THAT(result.output, Not(HasSubstr("empty")));
  const Result flat = program.run("render volume --describe --set data=flat.nrrd");
  EXPECT_THAT(flat.output, HasSubstr("all values are equal (7)"));
}

TEST(Describe, PrintsNotesOnce) {
  const Program program;
  program.write("types.xyz", "1\n\n6 0 0 0\n1\n\n6 1 0 0\n");
  const Result result = program.run("render particles --describe --set data=types.xyz");
  EXPECT_EQ(result.code, 0) << result.output;
  const auto first = result.output.find("read as atomic numbers");
  ASSERT_NE(first, std::string::npos) << result.output;
  EXPECT_EQ(result.output.find("read as atomic numbers", first + 1), std::string::npos)
      << result.output;
  EXPECT_THAT(result.output, HasSubstr("frames: 2 (0 to 1; this is frame 0;"));
  EXPECT_THAT(result.output, HasSubstr("radii: 1.7 Å, all equal\n"));
  EXPECT_THAT(result.output, HasSubstr("Å, including the radii\n"));
}

}  // namespace
}  // namespace triptych::command_line
