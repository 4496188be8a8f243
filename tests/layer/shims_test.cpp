// Tests OpenCL and OpenGL drivers that have a fault.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <regex>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::layer {
namespace {

using testing::HasSubstr;
using testing::Not;

class Shims : public testing::Test {
 protected:
  [[nodiscard]] test::Result draw(const std::string& environment, std::string_view device,
                                  std::string_view plan, const std::string& more = {}) const {
    return test::run_command(fmt::format(
        "cd '{}' && rm -f shim.sqlite && TRIPTYCH_DATA= {} '{}' run '{}/{}.yaml' --device {} "
        "--untimed --store shim.sqlite {}",
        folder_.path().string(), environment, TRIPTYCH_PROGRAM, TRIPTYCH_LAYER_PLANS, plan, device,
        more));
  }
  [[nodiscard]] test::Result opencl(std::string_view fault, std::string_view plan) const {
    return draw(fmt::format("LD_PRELOAD='{}' TRIPTYCH_SHIM={}", TRIPTYCH_OPENCL_SHIM, fault),
                "opencl:pocl", plan);
  }
  // Returns whether the gate finds that every configuration of the last draw() is wrong.
  [[nodiscard]] bool every_image_is_wrong(std::string_view plan) const {
    const test::Result judged = test::run_command(
        fmt::format("cd '{}' && TRIPTYCH_DATA= '{}' gate '{}/{}.yaml' --check image --baselines "
                    "none --store shim.sqlite",
                    folder_.path().string(), TRIPTYCH_PROGRAM, TRIPTYCH_LAYER_PLANS, plan));
    return std::regex_search(judged.output, std::regex(R"(([0-9]+) of \1 checks wrong)"));
  }
  static bool lacks_device(const test::Result& result) {
    return result.output.find("no device matches") != std::string::npos;
  }

  [[nodiscard]] std::string folder() const { return folder_.path().string(); }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(Shims, OpenclWithoutAFaultIsMeasured) {
  const test::Result drawn = opencl("none", "volume");
  if (lacks_device(drawn)) GTEST_SKIP() << "needs PoCL";
  EXPECT_THAT(drawn.output, HasSubstr(" 0 failed"));
}

TEST_F(Shims, OpenclKernelsThatRunOnlyOnceAreFound) {
  for (const char* plan : {"volume", "particles"}) {
    const test::Result drawn = opencl("once_only", plan);
    if (lacks_device(drawn)) GTEST_SKIP() << "needs PoCL";
    EXPECT_THAT(drawn.output, HasSubstr(" 0 measured"));
  }
}

TEST_F(Shims, OpenclKernelsThatEndAbnormallyAreReported) {
  for (const char* plan : {"volume", "particles"}) {
    const test::Result drawn = opencl("abnormal_end", plan);
    if (lacks_device(drawn)) GTEST_SKIP() << "needs PoCL";
    EXPECT_THAT(drawn.output, HasSubstr(" 0 measured"));
    EXPECT_THAT(drawn.output, HasSubstr("clEnqueueNDRangeKernel returned CL_INVALID_MEM_OBJECT"));
    EXPECT_THAT(drawn.output, HasSubstr("its execution failed"));
    EXPECT_THAT(drawn.output, Not(HasSubstr("backend.cpp")));
  }
}

TEST_F(Shims, RejectedOpenclLaunchesNameKernelAndSourceLocation) {
  const test::Result drawn = opencl("refused_launch", "volume");
  if (lacks_device(drawn)) GTEST_SKIP() << "needs PoCL";
  EXPECT_THAT(drawn.output, HasSubstr("clEnqueueNDRangeKernel returned CL_OUT_OF_RESOURCES"));
  EXPECT_THAT(drawn.output, HasSubstr("kernel raycast"));
  EXPECT_THAT(drawn.output, HasSubstr("volume_frames.cpp"));
}

// Everything must be measured, and the feature probe must report the fault.
TEST_F(Shims, LateOpenclEventsFailTheFeatureProbe) {
  const test::Result drawn = opencl("late_events", "volume");
  if (lacks_device(drawn)) GTEST_SKIP() << "needs PoCL";
  EXPECT_THAT(drawn.output, HasSubstr(" 0 failed"));
  const test::Result probed = test::run_command(fmt::format(
      "LD_PRELOAD='{}' TRIPTYCH_SHIM=late_events '{}' features --device opencl:pocl --only "
      "event-status",
      TRIPTYCH_OPENCL_SHIM, TRIPTYCH_PROGRAM));
  EXPECT_EQ(probed.code, 1);
  EXPECT_THAT(probed.output, HasSubstr("64 of 64 values are wrong"));
}

#ifdef TRIPTYCH_EGL_SHIM_FOLDER
class GlShims : public Shims {
 protected:
  [[nodiscard]] test::Result gl(std::string_view fault, std::string_view plan) const {
    return draw(
        fmt::format("LD_LIBRARY_PATH='{}' TRIPTYCH_SHIM={}", TRIPTYCH_EGL_SHIM_FOLDER, fault),
        "gl:llvmpipe-egl", plan);
  }
};

TEST_F(GlShims, EverythingIsMeasuredWithoutAFault) {
  const test::Result drawn = gl("none", "volume");
  if (lacks_device(drawn)) GTEST_SKIP() << "needs llvmpipe";
  EXPECT_THAT(drawn.output, HasSubstr(" 0 failed"));
}

TEST_F(GlShims, CommandsThatAreExecutedOnlyOnceAreFound) {
  for (const char* plan : {"volume", "particles"}) {
    const test::Result drawn = gl("once_only", plan);
    if (lacks_device(drawn)) GTEST_SKIP() << "needs llvmpipe";
    // With this fault, a program draws only when it is used for the first time. With occlusion
    // culling, frames are drawn before the first measured frame, so the measured frame shows only
    // the cleared background. That also counts as a wrong image.
    EXPECT_TRUE(every_image_is_wrong(plan)) << plan << '\n' << drawn.output;
  }
}

TEST_F(GlShims, UncompiledProgramsAreNotReportedAsWrongImages) {
  const test::Result drawn = gl("never_compiled", "volume");
  if (lacks_device(drawn)) GTEST_SKIP() << "needs llvmpipe";
  EXPECT_THAT(drawn.output, HasSubstr(" 0 measured"));
  EXPECT_THAT(drawn.output, HasSubstr("was not drawn: none of"));
}

TEST_F(GlShims, AnUndrawnInProcessFrameIsNotSaved) {
  const test::Result drawn = test::run_command(
      fmt::format("cd '{}' && LD_LIBRARY_PATH='{}' TRIPTYCH_SHIM=never_compiled '{}' render volume "
                  "--in-process --device gl:llvmpipe-egl --set viewport=16 --out frame",
                  folder(), TRIPTYCH_EGL_SHIM_FOLDER, TRIPTYCH_PROGRAM));
  if (lacks_device(drawn)) GTEST_SKIP() << "needs llvmpipe";
  EXPECT_THAT(drawn.output, HasSubstr("was not drawn: none of 256 pixels"));
  EXPECT_THAT(drawn.output, Not(HasSubstr("image.exr")));
}

TEST_F(GlShims, AnInfoLogWithNegativeLengthIsRead) {
  const test::Result drawn = gl("negative_log", "volume");
  if (lacks_device(drawn)) GTEST_SKIP() << "needs llvmpipe";
  EXPECT_THAT(drawn.output, HasSubstr("glCompileShader returned GL_FALSE"));
  EXPECT_THAT(drawn.output, HasSubstr("no luck"));
  EXPECT_THAT(drawn.output, Not(HasSubstr("basic_string")));
}
#endif

}  // namespace
}  // namespace triptych::layer
