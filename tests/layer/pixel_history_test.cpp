// Tests that `render --pixel` finds the first operation in which a device differs from the
// reference renderer.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "layered.hpp"
#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::layer {
namespace {

struct Traced {
  int code = 0;
  // the operation with the first difference; empty if there is no difference
  std::string operation;
  std::string output;
};

class PixelHistories : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] Traced trace(const std::string& more) const {
    const test::Result result = test::run_command(fmt::format(
        "cd '{}' && TRIPTYCH_DATA= '{}' render volume --device {} --pixel 7,8 --set viewport=16 "
        "--set data=generate:marschner_lobb:8 --out frame {}",
        folder_.path().string(), TRIPTYCH_PROGRAM, GetParam(), more));
    Traced traced{.code = result.code, .operation = {}, .output = result.output};
    constexpr std::string_view before = "first difference: ";
    const std::size_t at = result.output.find(before);
    if (at == std::string::npos) return traced;
    const std::size_t begin = at + before.size();
    traced.operation = result.output.substr(begin, result.output.find(" is ", begin) - begin);
    return traced;
  }

  void SetUp() override {
    const Traced traced = trace("");
    if (traced.output.find("no device") != std::string::npos) GTEST_SKIP() << "needs the device";
    ASSERT_EQ(traced.code, 0) << traced.output;
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_P(PixelHistories, ShowNoDifferenceOnACorrectDevice) {
  for (const char* each :
       {"--set skip=none --set shading=gradient", "--set sampler=manual --set step=0.5",
        "--set quadrature=preintegrated --set step=4", "--set budget=0.01 --set sampler=manual",
        "--set ert=0 --set precision=fp64 --set step=0.3", "--set adapt=0.004 --set skip=bricks"}) {
    const Traced traced = trace(each);
    EXPECT_EQ(traced.code, 0) << each << "\n" << traced.output;
  }
}

TEST_P(PixelHistories, NameTheFaultyOperation) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"--inject half_voxel_shift", "interpolated value"},
      {"--inject coarse_filter", "interpolated value"},
      {"--inject uncorrected_opacity", "ray length covered by the sample"}};
  for (const auto& [fault, operation] : faults) {
    const Traced traced = trace(fault + " --set sampler=manual --set step=0.5");
    EXPECT_EQ(traced.code, 1) << fault;
    EXPECT_EQ(traced.operation, operation) << traced.output;
  }
  EXPECT_EQ(trace("--inject extra_sample --set ert=0 --set skip=none").code, 1);
}

// The layer removes one work group from each dispatch, so 8 of 16 columns are not drawn.
TEST(UndrawnPixels, AreReportedWithTheirColumns) {
  const Layered layered;
  if (!layered.has_lavapipe()) GTEST_SKIP() << "needs lavapipe";
  const std::string frame =
      "render volume --device vulkan:lavapipe --set viewport=16 --set sampler=manual --out frame ";
  const test::Result compared = layered.run("short_dispatch", frame + "--truth");
  EXPECT_EQ(compared.code, 1) << compared.output;
  EXPECT_NE(compared.output.find("columns 8 to 15 and rows 0 to 15"), std::string::npos)
      << compared.output;
  for (const char* more : {"--in-process", "--dump dump", "--pixel 12,3"}) {
    const test::Result drawn = layered.run("short_dispatch", frame + more);
    EXPECT_EQ(drawn.code, 1) << more << "\n" << drawn.output;
    EXPECT_NE(drawn.output.find("128 of 256 pixels were not drawn"), std::string::npos)
        << drawn.output;
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, PixelHistories,
                         testing::Values("vulkan:lavapipe", "gl:llvmpipe-egl", "opencl:pocl"));

}  // namespace
}  // namespace triptych::layer
