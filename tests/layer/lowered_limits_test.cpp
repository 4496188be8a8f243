// Tests that devices with lower limits than lavapipe either produce correct images and counters, or
// skip the configuration with a reason.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "support/exhaustive_run.hpp"
#include "tests/layer/layered.hpp"

namespace triptych::layer {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* draws = "--set technique=raycast_fragment";

struct Lowered {
  std::string change;
  std::string_view plan;
  int skipped = 0;          // number of configurations of the plan that are skipped
  const char* reason = "";  // the reason of each of them
};

// Returns the lowered limits. Each has the lowest value that the specification allows, or a lower
// value if a small image could not reach the limit otherwise.
const std::vector<Lowered>& lowered() {
  static const std::vector<Lowered> all{
      {"maxImageDimension1D=4096", volume},
      {"maxImageDimension2D=48", particles, 8, "can draw at most 48x48"},
      {"maxImageDimension3D=16", volume, 2, "maxImageDimension3D is 16"},
      {"maxFramebufferWidth=48", particles, 8, "can draw at most 48x48"},
      {"maxStorageBufferRange=134217728", particles},
      {"maxUniformBufferRange=16384", particles},
      {"maxComputeSharedMemorySize=16384", particles},
      {"maxComputeWorkGroupInvocations=128", volume},
      {"maxComputeWorkGroupInvocations=128", particles},
      {"maxComputeWorkGroupSize=64", particles},
      {"maxComputeWorkGroupCount=65535", particles},
      {"maxPerStageDescriptorStorageBuffers=4", volume},
      {"maxPerStageDescriptorStorageBuffers=12", particles},
      {"maxPerStageResources=128", particles},
      {"maxDescriptorSetStorageBuffers=24", particles},
      {"maxTessellationGenerationLevel=1", particles, 1, "maxTessellationGenerationLevel"},
      {"maxDrawIndirectCount=1", particles},
      {"multiDrawIndirect", particles},
      {"drawIndirectFirstInstance", particles, 1, "lacks drawIndirectFirstInstance"},
      {"geometryShader", particles, 3, "lacks geometryShader"},
      {"tessellationShader", particles, 3, "lacks tessellationShader"},
      {"fragmentStoresAndAtomics", particles, 11, "lacks fragmentStoresAndAtomics"},
      {"fragmentStoresAndAtomics", volume, 3, "lacks fragmentStoresAndAtomics"},
      {"vertexPipelineStoresAndAtomics", particles, 11, "lacks vertexPipelineStoresAndAtomics"},
      {"vertexPipelineStoresAndAtomics", volume},
      {"pipelineStatisticsQuery", particles},
      {"shaderFloat64", volume, 1, "needs shaderFloat64"},
      {"largePoints", particles},
      {"pointSizeRange=8", particles},
      {"pointSizeGranularity=0.0625", particles},
      {"pointSizeGranularity=1", particles},
      {"subPixelPrecisionBits=4", particles},
      {"subTexelPrecisionBits=4", volume},
      {"floatDepth", particles, 11, "sampled depth buffers of format D32Sfloat"},
      {"linearFilter", volume, 4, "cannot filter images of format"},
      {"timestampValidBits=0", volume},
      {"timestampComputeAndGraphics", volume},
      {"graphicsQueue", volume, 3, "no graphics queue"},
      {"computeFamilyFirst", particles},
      {"hostVisibleDeviceLocal", volume},
      {"hostVisibleDeviceLocal", particles},
      {"memoryHeapSize=150000", volume, 2, "the largest heap has 150000"},
      {"emptyHeap", volume},
      {"emptyHeap", particles},
      {"maxMemoryAllocationSize=150000", volume, 2, "maxMemoryAllocationSize is 150000"},
  };
  return all;
}

int count(const std::string& text, const std::string& part) {
  int times = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++times;
  }
  return times;
}

// Returns the rows of a plan. Each row takes seconds to run. Outside the nightly run, all limits
// that cause no configuration to be skipped are therefore combined into one row. Two kinds of limit
// keep rows of their own: those that are listed twice, and `emptyHeap`, because it conflicts with
// `hostVisibleDeviceLocal`.
std::vector<Lowered> rows_of(std::string_view plan) {
  std::vector<Lowered> rows;
  std::vector<std::string> names;
  std::string combined;
  for (const Lowered& each : lowered()) {
    if (each.plan != plan) continue;
    const std::string name = each.change.substr(0, each.change.find('='));
    const bool repeated = std::ranges::find(names, name) != names.end();
    if (test::is_exhaustive_run() || each.skipped > 0 || repeated || name == "emptyHeap") {
      rows.push_back(each);
      continue;
    }
    names.push_back(name);
    combined += (combined.empty() ? "" : ";") + each.change;
  }
  if (!combined.empty()) rows.push_back({combined, plan});
  return rows;
}

class LoweredLimits : public LayerTest {
 protected:
  // Draws the plan once for each of its rows of lowered limits, and checks what is skipped and that
  // the rest is correct.
  void check(std::string_view plan) const {
    const test::Result accepted = layered.accept(plan);
    ASSERT_EQ(accepted.code, 0) << accepted.output;
    for (const Lowered& each : rows_of(plan)) {
      SCOPED_TRACE(each.change);
      const test::Result drawn = layered.draw(each.change, plan);
      EXPECT_THAT(drawn.output, Not(HasSubstr("layer: refused")));
      EXPECT_THAT(drawn.output, HasSubstr(fmt::format(" {} skipped, 0 failed", each.skipped)));
      EXPECT_EQ(count(drawn.output, "skipped: "), each.skipped);
      EXPECT_THAT(drawn.output, HasSubstr(each.reason));
      const test::Result judged = layered.judge(plan);
      const bool any = drawn.output.find(" 0 measured") == std::string::npos;
      EXPECT_EQ(judged.code, any ? 0 : 2) << judged.output;
    }
  }
};

TEST_F(LoweredLimits, AreHandledForVolumes) {
  check(volume);
}

TEST_F(LoweredLimits, AreHandledForParticles) {
  check(particles);
}

TEST_F(LoweredLimits, TheRestIsMeasuredWithoutStatistics) {
  const test::Result timed = layered.time("pipelineStatisticsQuery", volume, draws);
  EXPECT_EQ(timed.code, 0) << timed.output;
  EXPECT_THAT(timed.output, Not(HasSubstr("layer: refused")));
}

TEST_F(LoweredLimits, WallTimeIsUsedWithoutADeviceClock) {
  const test::Result timed = layered.time("timestampValidBits=0", volume, draws);
  EXPECT_EQ(timed.code, 0) << timed.output;
  EXPECT_THAT(timed.output, Not(HasSubstr("layer: refused")));
  EXPECT_THAT(timed.output, HasSubstr(" ms (wall)"));
  EXPECT_THAT(timed.output, Not(HasSubstr(" ms (device)")));
}

// Tests the layer itself: it offers no device if the name of the limit is unknown, and it rejects
// calls that exceed a limit. The two limits are set to values that the specification does not
// permit, so Triptych does not check them and makes such calls.
TEST_F(LoweredLimits, UseBeyondALimitIsRejected) {
  const std::string unknown = layered.draw("noSuchLimit", volume).output;
  EXPECT_THAT(unknown, HasSubstr("no device matches vulkan:*"));
  EXPECT_THAT(unknown, HasSubstr("TRIPTYCH_LAYER=noSuchLimit"));
  const std::string unchecked = layered.draw("maxImageDimension1D=128", volume).output;
  // Newer versions of Vulkan-Hpp report Device::createImage instead of vkCreateImage.
  EXPECT_THAT(unchecked, HasSubstr("reateImage returned ErrorUnknown"));
  EXPECT_THAT(layered.draw("maxPerStageResources=12", particles).output,
              testing::ContainsRegex("[.]tiles[.][^ ]*[.]v64: failed: "));
}

// A layer that the loader cannot use must not be ignored, because the results would be attributed
// to the layer. The folder first lacks the layer, and then contains its description without its
// library.
TEST_F(LoweredLimits, AMissingLayerIsAnError) {
  const test::TemporaryFolder folder;
  const auto expect_reason = [&](const std::string& variables, const std::string& reason) {
    const test::Result result = test::run_command(fmt::format(
        "cd '{0}' && TRIPTYCH_DATA= VK_LAYER_PATH='{0}' {1} '{2}' run '{3}/volume.yaml' "
        "--untimed --device 'vulkan:*' --store s.sqlite",
        folder.path().string(), variables, TRIPTYCH_PROGRAM, TRIPTYCH_LAYER_PLANS));
    EXPECT_EQ(result.code, 2) << result.output;
    EXPECT_THAT(result.output, HasSubstr(reason));
  };
  expect_reason("TRIPTYCH_LAYER=half_pixel", "TRIPTYCH_LAYER=half_pixel");
  const std::string requested =
      "TRIPTYCH_LAYER=half_pixel VK_INSTANCE_LAYERS=VK_LAYER_TRIPTYCH_test";
  expect_reason(requested, folder.path().string());
  std::filesystem::copy_file(std::filesystem::path(TRIPTYCH_LAYER_FOLDER) / "triptych_layer.json",
                             folder.path() / "triptych_layer.json");
  expect_reason(requested, "--target triptych_layer");
}

}  // namespace
}  // namespace triptych::layer
