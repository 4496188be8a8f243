#include "measure/protocol/injected_fault.hpp"

#include <gmock/gmock.h>

#include <csignal>

#include "core/error.hpp"

namespace triptych::measure {
namespace {

technique::RaycastOptions injected(std::string_view fault) {
  Work work{.technique = "raycast", .scene = VolumeWork{}};
  inject(fault, work);
  return std::get<VolumeWork>(work.scene).options;
}

TEST(InjectedFault, PutsTheNamedFaultIntoTheOptions) {
  using technique::Fault;
  EXPECT_EQ(injected("half_voxel_shift").fault, Fault::half_voxel_shift);
  EXPECT_EQ(injected("flipped_axis").fault, Fault::flipped_axis);
  EXPECT_EQ(injected("extra_sample").fault, Fault::extra_sample);
  EXPECT_EQ(injected("uncorrected_opacity").fault, Fault::uncorrected_opacity);
  EXPECT_EQ(injected("coarse_filter").fault, Fault::coarse_filter);
}

TEST(InjectedFault, IsParsedWithItsTarget) {
  const std::vector<std::string> texts{"crash", "slowdown:1@step=2", "hang@a@b"};
  const std::vector<InjectedFault> faults = parse_faults(texts);
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0].fault + "|" + faults[0].only, "crash|");
  EXPECT_EQ(faults[1].fault + "|" + faults[1].only, "slowdown:1|step=2");
  EXPECT_EQ(faults[2].fault + "|" + faults[2].only, "hang|a@b");
}

TEST(InjectedFault, ASlowdownIsEveryNthRowTwice) {
  EXPECT_EQ(injected("slowdown:20").extra_work_stride, 5);
  EXPECT_EQ(injected("slowdown:3").extra_work_stride, 33);
  EXPECT_EQ(injected("slowdown:100").extra_work_stride, 1);
  EXPECT_EQ(injected("slowdown:2.5").extra_work_stride, 40);
}

TEST(InjectedFault, IsLimitedByLevelsOrByAPattern) {
  const auto applies = [](const char* only) {
    const InjectedFault fault{"slowdown:1", only};
    return !faults_for({&fault, 1}, "data=ball,step=2,technique=raycast", "gl:x").empty();
  };
  for (const char* only : {"", "step=2", "technique=raycast,step=2", "*ball*", "gl:*"}) {
    EXPECT_TRUE(applies(only)) << only;
  }
  for (const char* only : {"step=1", "step=2,skip=none", "raycast", "vulkan:*", ","}) {
    EXPECT_FALSE(applies(only)) << only;
  }
}

TEST(InjectedFault, UnknownNamesAndImpossibleSlowdownsAreRejected) {
  for (const char* fault : {"", "half_voxel", "slowdown", "slowdown:", "slowdown:0", "slowdown:-5",
                            "slowdown:101", "slowdown:5x", "slowdown:nan"}) {
    EXPECT_THROW(check_fault(fault), core::InputError) << fault;
  }
}

TEST(InjectedFault, ALostDeviceIsThrownAndACrashIsReal) {
  EXPECT_THROW(static_cast<void>(injected("device_lost")), core::DeviceLost);
  // The stack of the crash contains the function that raised the signal.
  EXPECT_EXIT(static_cast<void>(injected("crash")), testing::KilledBySignal(SIGSEGV), "libc");
}

}  // namespace
}  // namespace triptych::measure
