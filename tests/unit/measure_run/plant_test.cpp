#include "measure/protocol/plant.hpp"

#include <gmock/gmock.h>

#include <csignal>

#include "core/error.hpp"

namespace triptych::measure {
namespace {

technique::RaycastOptions planted(std::string_view fault) {
  Work work{.technique = "raycast", .scene = VolumeWork{}};
  apply_plant(fault, work);
  return std::get<VolumeWork>(work.scene).options;
}

TEST(Plant, PutsTheNamedFaultIntoTheOptions) {
  using technique::Fault;
  EXPECT_EQ(planted("half_voxel_shift").fault, Fault::half_voxel_shift);
  EXPECT_EQ(planted("flipped_axis").fault, Fault::flipped_axis);
  EXPECT_EQ(planted("extra_sample").fault, Fault::extra_sample);
  EXPECT_EQ(planted("uncorrected_opacity").fault, Fault::uncorrected_opacity);
  EXPECT_EQ(planted("coarse_filter").fault, Fault::coarse_filter);
}

TEST(Plant, ASlowdownIsEveryNthRowTwice) {
  EXPECT_EQ(planted("slowdown:20").extra_work_stride, 5);
  EXPECT_EQ(planted("slowdown:3").extra_work_stride, 33);
  EXPECT_EQ(planted("slowdown:100").extra_work_stride, 1);
  EXPECT_EQ(planted("slowdown:2.5").extra_work_stride, 40);
}

TEST(Plant, UnknownNamesAndImpossibleSlowdownsAreRefused) {
  for (const char* fault : {"", "half_voxel", "slowdown", "slowdown:", "slowdown:0", "slowdown:-5",
                            "slowdown:101", "slowdown:5x", "slowdown:nan"}) {
    EXPECT_THROW(check_plant(fault), core::InputError) << fault;
  }
}

TEST(Plant, ALostDeviceIsThrownAndACrashIsReal) {
  EXPECT_THROW(static_cast<void>(planted("device_lost")), core::DeviceLost);
  EXPECT_EXIT(static_cast<void>(planted("crash")), testing::KilledBySignal(SIGSEGV), "");
}

}  // namespace
}  // namespace triptych::measure
