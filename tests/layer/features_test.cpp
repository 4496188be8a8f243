// Tests the command `features`, which probes features that no scene uses, and finds faults that no
// other check finds.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/layer/layered.hpp"

namespace triptych::layer {
namespace {

using testing::HasSubstr;
using testing::Not;

class Features : public LayerTest {};

TEST_F(Features, AreCorrectOrSkippedWithAReason) {
  const test::Result result = layered.run("", "features --device vulkan:lavapipe");
  EXPECT_EQ(result.code, 0) << result.output;
  for (const char* each :
       {"work-groups", "push-constants", "dynamic-offsets", "subgroups", "repeat", "border",
        "wide-image", "indirect-draws", "instances", "base-vertex"}) {
    EXPECT_THAT(result.output, testing::ContainsRegex(fmt::format("  {} +right", each)));
  }
  EXPECT_THAT(result.output, HasSubstr("10000000 instances"));
}

// Each fault is found by the probe that uses the broken feature.
TEST_F(Features, FaultsAreFoundByTheirProbe) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"short_dispatch", "work-groups"},
      {"push_off_by_one", "dynamic-offsets"},
      {"repeated_edge", "border"},
      {"short_indirect", "indirect-draws"}};
  for (const auto& [fault, feature] : faults) {
    const test::Result result =
        layered.run(fault, "features --device vulkan:lavapipe --only " + feature);
    EXPECT_EQ(result.code, 1) << fault << "\n" << result.output;
    EXPECT_THAT(result.output, HasSubstr("wrong"));
  }
}

TEST_F(Features, ALostDeviceReportsTheSubmission) {
  const test::Result result =
      layered.run("lost_after=12", "features --device vulkan:lavapipe --only work-groups");
  EXPECT_EQ(result.code, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("submission 13 of this process"));
}

TEST(FeaturesOfOtherApis, AreCorrect) {
  const Layered layered;
  for (const char* device : {"gl:llvmpipe-egl", "opencl:pocl"}) {
    const test::Result result = layered.run("", fmt::format("features --device {}", device));
    if (result.output.find("no device matches") != std::string::npos) continue;
    EXPECT_EQ(result.code, 0) << result.output;
    EXPECT_THAT(result.output, Not(HasSubstr("wrong")));
  }
}

}  // namespace
}  // namespace triptych::layer
