// Tests `render --pixel` for particles, which tests spheres one by one and finds the smallest set
// for which the pixel is wrong.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::layer {
namespace {

using testing::HasSubstr;

class SpriteHistories : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] test::Result trace(const std::string& more) const {
    return test::run_command(
        fmt::format("cd '{}' && TRIPTYCH_DATA= '{}' render particles --device {} --pixel 16,16 "
                    "--set viewport=32 --set data=generate:uniform:300 --out frame {}",
                    folder_.path().string(), TRIPTYCH_PROGRAM, GetParam(), more));
  }
  void SetUp() override {
    if (trace("").output.find("no device") != std::string::npos) GTEST_SKIP() << "needs the device";
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_P(SpriteHistories, ShowNoDifferenceOnACorrectDevice) {
  for (const char* technique : {"quad_instanced", "tiles", "bvh"}) {
    const test::Result result = trace(fmt::format("--set technique={}", technique));
    EXPECT_EQ(result.code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("no sphere differs"));
  }
}

// With reversed depth, each sphere is drawn correctly on its own. Two spheres are needed to reveal
// the fault.
TEST_P(SpriteHistories, FindTheSpheresThatAreWrongTogether) {
  const test::Result result = trace("--set technique=quad_instanced --inject reversed_depth");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.output, HasSubstr("when these 2 spheres are drawn together"));
}

INSTANTIATE_TEST_SUITE_P(Devices, SpriteHistories,
                         testing::Values("vulkan:lavapipe", "gl:llvmpipe-egl", "opencl:pocl"));

}  // namespace
}  // namespace triptych::layer
