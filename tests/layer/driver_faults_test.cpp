// Tests that each fault of a driver is found, is reported as only a few causes, and is attributed
// to the driver, while everything else still passes.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <regex>
#include <vector>

#include "tests/layer/layered.hpp"

namespace triptych::layer {
namespace {

using testing::HasSubstr;

// States whether a fault makes some configurations fail before images are compared, because their
// image looks as if none of its pixels was written. `perhaps` is for a fault that copies too few
// bytes. Depending on the earlier contents of the driver's memory, the pixels that are not copied
// may or may not look unwritten.
enum class Undrawn : std::uint8_t { no, yes, perhaps };

struct Fault {
  const char* name;
  const char* plan;
  const char* message;  // the first reported cause
  int causes = 1;
  Undrawn undrawn = Undrawn::no;
};

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all{
      {"half_pixel", particles, "image: vulkan:lavapipe"},
      {"inverted_depth", particles, "image: vulkan:lavapipe"},
      {"no_depth_write", particles, "image: vulkan:lavapipe", 2},
      {"culled_front", particles,
       "image: vulkan:lavapipe, culling=occlusion, viewport=64 (4 configurations)"},
      {"culled_back", volume, "image: vulkan:lavapipe, technique=raycast_fragment", 1,
       Undrawn::yes},
      {"lost_alpha", particles, "image: vulkan:lavapipe"},
      {"lost_alpha", volume, "image: vulkan:lavapipe, technique=raycast_fragment"},
      {"unspecialized", volume, "counters: vulkan:lavapipe", 2},
      {"nearest_filter", volume, "image: vulkan:lavapipe, sampler=hardware"},
      {"repeated_edge", volume,
       "image: vulkan:lavapipe, data=generate:marschner_lobb:16, sampler=hardware", 2},
      {"short_draw", particles, "counters: vulkan:lavapipe, culling=none", 2},
      {"short_draw", volume, "image: vulkan:lavapipe, technique=raycast_fragment", 1, Undrawn::yes},
      {"short_indirect", particles, "image: vulkan:lavapipe, culling=occlusion"},
      {"short_dispatch", volume, "image: vulkan:lavapipe, technique=raycast"},
      {"short_scissor", volume, "image: vulkan:lavapipe, technique=raycast_fragment"},
      {"short_scissor", particles, "image: vulkan:lavapipe"},
      {"push_off_by_one", particles, "image: vulkan:lavapipe, culling=occlusion, technique=tiles"},
      {"clear_colour", particles, "image: vulkan:lavapipe"},
      {"clear_depth", particles, "image: vulkan:lavapipe"},
      {"short_copy", volume, "image: vulkan:lavapipe", 3, Undrawn::perhaps},
      {"image_row", particles, "image: vulkan:lavapipe"},
      {"volume_slice", volume, "image: vulkan:lavapipe"},
  };
  return all;
}

// Returns the number of causes: those on the last screen (the summary at the end of a gate), each
// of which follows an empty line, plus those that are shown only on the HTML page.
int causes_in(const std::string& screen) {
  const std::regex cause("\n\n  ✗ ");
  int causes = static_cast<int>(std::distance(
      std::sregex_iterator(screen.begin(), screen.end(), cause), std::sregex_iterator()));
  std::smatch more;
  if (std::regex_search(screen, more, std::regex("\n  ([0-9]+) more causes?"))) {
    causes += std::stoi(more[1]);
  }
  return causes;
}

// Joins the lines of the screen into one, because line breaks depend on the width.
std::string unwrapped(const std::string& screen) {
  return std::regex_replace(screen, std::regex("\\s+"), " ");
}

class DriverFaults : public LayerTest {
 protected:
  // Simulates each fault that this plan can detect, and checks that the gate finds it.
  void check(std::string_view plan) const {
    const test::Result accepted = layered.accept(plan);
    ASSERT_EQ(accepted.code, 0) << accepted.output;
    EXPECT_EQ(layered.judge(plan).code, 0);
    for (const Fault& each : faults()) {
      if (each.plan != plan) continue;
      SCOPED_TRACE(each.name);
      const test::Result drawn = layered.draw(each.name, plan);
      if (each.undrawn != Undrawn::perhaps) {
        EXPECT_THAT(drawn.output,
                    HasSubstr(each.undrawn == Undrawn::yes ? "pixels was written" : " 0 failed"));
      }
      const test::Result judged = layered.judge(plan);
      EXPECT_EQ(judged.code, 1);
      EXPECT_THAT(judged.output, HasSubstr(fmt::format("\n  ✗ {}", each.message)));
      EXPECT_LE(causes_in(judged.output), each.causes) << judged.output;
      EXPECT_THAT(judged.output, HasSubstr(fmt::format("TRIPTYCH_LAYER={} ", each.name)));
      EXPECT_THAT(unwrapped(judged.output), HasSubstr("; the driver is at fault"));
    }
  }
};

TEST_F(DriverFaults, AreFoundInVolumes) {
  check(volume);
}

TEST_F(DriverFaults, AreFoundInParticles) {
  check(particles);
}

TEST_F(DriverFaults, AreDistinguishedFromFaultsOfTriptych) {
  const std::string devices = "--device vulkan:lavapipe --device opencl:pocl";
  const test::Result accepted = layered.accept(particles, devices);
  if (accepted.output.find("no device matches opencl:pocl") != std::string::npos) {
    GTEST_SKIP() << "needs PoCL";
  }
  ASSERT_EQ(accepted.code, 0) << accepted.output;
  EXPECT_EQ(layered.draw("", particles, devices + " --inject small_sprite").code, 0);
  const std::string verdicts = layered.log_of(particles);
  EXPECT_THAT(verdicts, HasSubstr("the driver is not at fault, because opencl:pocl is"));
  EXPECT_THAT(verdicts, HasSubstr("the driver is not at fault, because vulkan:lavapipe is"));
  EXPECT_THAT(verdicts, testing::Not(HasSubstr("the driver is at fault")));
}

TEST_F(DriverFaults, InQueriesAreReportedByDevices) {
  const auto vulkan_report = [&](std::string_view fault) {
    const std::string all = layered.run(fault, "devices --device vulkan:lavapipe").output;
    return all.substr(std::min(all.find("vulkan:lavapipe"), all.size()));
  };
  EXPECT_THAT(vulkan_report("stuck_clock"), HasSubstr("clock for compute: not trusted"));
  EXPECT_THAT(vulkan_report("double_statistics"),
              HasSubstr("statistic vertex_invocations: always 2 times the correct count"));
}

}  // namespace
}  // namespace triptych::layer
