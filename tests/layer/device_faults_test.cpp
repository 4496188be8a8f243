// Tests that a fault which occurs while a device is calibrated or closed becomes a finding about
// that device, and that everything else is still measured.
#include <gmock/gmock.h>

#include <regex>
#include <vector>

#include "tests/layer/layered.hpp"

namespace triptych::layer {
namespace {

using testing::HasSubstr;
using testing::Not;

// Selects the configurations of volume.yaml with this data, of which there is one for each kind of
// device work: raycast computes, and raycast_fragment draws.
constexpr const char* few = "--set data=generate:mandelbulb:40";

struct DeviceFaultCase {
  const char* change;
  const char* message;
};

const std::vector<DeviceFaultCase>& device_faults() {
  static const std::vector<DeviceFaultCase> all{
      {"zero_clock", "the device's clock always reads 0"},
      {"untouched_clock", "never writes the requested timestamps"},
      {"zero_statistics", "all pipeline statistics are 0"},
      {"crashing_statistics", "the driver crashes when pipeline statistics are read"},
      {"unready_statistics", "pipeline statistics do not become available"},
      {"crash_with_device", "the driver crashes when the device is closed"},
      {"hang_with_device", "the driver hangs when the device is closed"},
      {"crash_at_exit", "the driver crashes when the device is closed"},
  };
  return all;
}

class DeviceFaults : public LayerTest {
 protected:
  [[nodiscard]] test::Result judged() const {
    return layered.run("", fmt::format("gate '{}/volume.yaml' --store timed.sqlite --baselines "
                                       "none --check image",
                                       TRIPTYCH_LAYER_PLANS));
  }
  static std::string unwrapped(const std::string& screen) {
    return std::regex_replace(screen, std::regex("\\s+"), " ");
  }
};

TEST_F(DeviceFaults, AreReportedAndTheRestIsMeasured) {
  for (const DeviceFaultCase& each : device_faults()) {
    SCOPED_TRACE(each.change);
    EXPECT_THAT(layered.time(each.change, "volume", few).output, HasSubstr(" 0 failed"));
    const test::Result result = judged();
    EXPECT_EQ(result.code, 1) << result.output;
    EXPECT_THAT(unwrapped(result.output), HasSubstr(each.message));
  }
}

TEST_F(DeviceFaults, NoFindingWithoutAFault) {
  EXPECT_EQ(layered.time("", "volume", few).code, 0);
  EXPECT_THAT(unwrapped(judged().output), Not(HasSubstr("the device's clock")));
}

// The layer leaks 8 MiB per buffer, and every configuration creates several buffers.
TEST_F(DeviceFaults, MemoryThatIsNotFreedIsAFinding) {
  for (const char* change : {"leak", ""}) {
    const std::string store = fmt::format("memory{}.sqlite", change);
    const test::Result drawn = layered.run(
        change,
        "run volume/quick --device vulkan:lavapipe --untimed --set technique=raycast --set "
        "data=generate:marschner_lobb:8 --set viewport=16 --set sampler=manual,packed --set "
        "voxel=u8,u16,f32 --set shading=none,gradient --set transfer_function=haze --store " +
            store);
    EXPECT_THAT(drawn.output, HasSubstr(" 0 failed"));
    const test::Result result =
        layered.run("", "gate volume/quick --check image --baselines none --store " + store);
    const bool found =
        unwrapped(result.output).find("the memory usage of the process grows") != std::string::npos;
    EXPECT_EQ(found, change == std::string_view("leak")) << result.output;
    const bool has_row = result.output.find("  Driver      FAIL") != std::string::npos;
    EXPECT_EQ(has_row, change == std::string_view("leak")) << result.output;
  }
}

TEST_F(DeviceFaults, ALostDeviceReportsTheSubmission) {
  const test::Result drawn = layered.draw("lost_after=40", "volume");
  EXPECT_THAT(unwrapped(drawn.output), HasSubstr("submission 41 of this process"));
}

TEST_F(DeviceFaults, AChangedRoundingModeIsAttributedToTheDriver) {
  const test::Result drawn = layered.draw("rounding", "volume");
  EXPECT_THAT(unwrapped(drawn.output),
              HasSubstr("changed the floating-point mode of this process"));
  EXPECT_THAT(unwrapped(drawn.output), HasSubstr("rounds upward"));
}

TEST_F(DeviceFaults, ACrashLeavesAStackTrace) {
  static_cast<void>(layered.time("crashing_statistics", "volume", few));
  EXPECT_THAT(unwrapped(judged().output), HasSubstr("libtriptych_layer.so("));
}

}  // namespace
}  // namespace triptych::layer
