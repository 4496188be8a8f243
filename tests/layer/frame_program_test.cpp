// Tests `render --in-process` and `--dump`, which draw one frame and write a C program that draws
// the same frame again.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <regex>

#include "core/image_io.hpp"
#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::layer {
namespace {

using testing::HasSubstr;

class FramePrograms : public testing::Test {
 protected:
  [[nodiscard]] test::Result in_folder(const std::string& command) const {
    return test::run_command(
        fmt::format("cd '{}' && TRIPTYCH_DATA= {}", folder_.path().string(), command));
  }
  [[nodiscard]] test::Result render(const std::string& device, const std::string& more) const {
    return in_folder(fmt::format(
        "'{}' render volume --device {} --set technique=raycast --set viewport=16 --set "
        "data=generate:marschner_lobb:8 --out frame --dump dump {}",
        TRIPTYCH_PROGRAM, device, more));
  }

  // Renders a frame, compiles the C program that `--dump` writes, and checks that this program
  // prints the same colour of the middle pixel as the rendered image has. The program must detect
  // an injected fault.
  void expect_same_pixel(const std::string& device, const std::string& libraries,
                         const std::string& choice, const std::string& more) const {
    SCOPED_TRACE(device + " " + more);
    const test::Result rendered = render(device, more);
    if (rendered.output.find("no device") != std::string::npos) GTEST_SKIP() << "needs " << device;
    ASSERT_EQ(rendered.code, 0) << rendered.output;
    const test::Result compiled =
        in_folder(fmt::format("cc dump/frame.c {} -o frame-program", libraries));
    ASSERT_EQ(compiled.code, 0) << compiled.output;
    EXPECT_LT(lines(), 420);
    const test::Result printed = in_folder("./frame-program 7 8 " + choice);
    const bool injected = more.find("--inject") != std::string::npos;
    ASSERT_EQ(printed.code, injected ? 1 : 0) << printed.output;
    EXPECT_THAT(printed.output, HasSubstr("expected: "));
    std::smatch found;
    ASSERT_TRUE(std::regex_search(printed.output, found,
                                  std::regex("pixel \\(7, 8\\): (\\S+) (\\S+) (\\S+) (\\S+)")))
        << printed.output;
    const core::Image image = core::read_exr(folder_.path() / "frame" / "image.exr");
    for (std::size_t channel = 0; channel < 4; ++channel) {
      EXPECT_EQ(std::stof(found[channel + 1]), image.pixel(7, 8).at(channel));
    }
  }

  [[nodiscard]] std::ptrdiff_t lines() const {
    std::ifstream file(folder_.path() / "dump" / "frame.c");
    return std::count(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>(), '\n');
  }

  test::TemporaryFolder folder_;
};

const std::vector<std::string>& frames() {
  static const std::vector<std::string> all{
      "--set sampler=hardware", "--set sampler=manual --set voxel=u8",
      "--set sampler=manual --inject half_voxel_shift --set voxel=f32"};
  return all;
}

TEST_F(FramePrograms, VulkanProgramsDrawTheSamePixel) {
  for (const std::string& each : frames()) {
    expect_same_pixel("vulkan:lavapipe", "-lvulkan", "", each);
  }
  expect_same_pixel("vulkan:lavapipe", "-lvulkan", "", "--set sampler=packed");
}

TEST_F(FramePrograms, OpenglProgramsDrawTheSamePixel) {
  for (const std::string& each : frames()) {
    expect_same_pixel("gl:llvmpipe-egl", "-lEGL -lOpenGL", "", each);
  }
  expect_same_pixel("gl:llvmpipe-egl", "-lEGL -lOpenGL", "", "--set sampler=packed");
}

TEST_F(FramePrograms, OpenclProgramsDrawTheSamePixel) {
  for (const std::string& each : frames()) {
    expect_same_pixel("opencl:pocl", "-lOpenCL", "Portable", each);
  }
}

TEST_F(FramePrograms, DumpsListAllDriverInputs) {
  const test::Result rendered = render("opencl:pocl", "");
  if (rendered.output.find("no device") != std::string::npos) GTEST_SKIP() << "needs PoCL";
  std::ifstream file(folder_.path() / "dump" / "what-was-given.txt");
  const std::string list{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(list, HasSubstr("program-"));
  EXPECT_THAT(list, HasSubstr("-cl-std=CL1.2"));
  EXPECT_THAT(list, HasSubstr("built in "));
  EXPECT_THAT(list, HasSubstr("buffer-"));
}

// The script compile.sh in the dump compiles the device code with public tools, such as clang,
// which must accept the code of every API.
TEST_F(FramePrograms, DumpsCompileWithPublicTools) {
  std::vector<std::string> devices{"vulkan:lavapipe", "gl:llvmpipe-egl"};
  if (in_folder("command -v clang").code == 0) devices.emplace_back("opencl:pocl");
  for (const std::string& device : devices) {
    std::filesystem::remove_all(folder_.path() / "dump");
    const test::Result rendered = render(device, "");
    if (rendered.output.find("no device") != std::string::npos) continue;
    const test::Result compiled = in_folder("dump/compile.sh");
    EXPECT_EQ(compiled.code, 0) << device << "\n" << compiled.output;
  }
}

// Uses a replacement for RenderDoc that prints the calls it receives.
TEST_F(FramePrograms, OneFrameIsCaptured) {
  const test::Result rendered = in_folder(fmt::format(
      "LD_PRELOAD='{}' TRIPTYCH_NULL_SCRIPT={{}} '{}' render volume --device null:scripted "
      "--in-process --out frame",
      TRIPTYCH_CAPTURE_SHIM, TRIPTYCH_PROGRAM));
  EXPECT_THAT(rendered.output, HasSubstr("capture to "));
  EXPECT_THAT(rendered.output, HasSubstr("capture begins\ncapture ends\n"));
}

}  // namespace
}  // namespace triptych::layer
