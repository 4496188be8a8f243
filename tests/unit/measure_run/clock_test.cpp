#include "measure/protocol/clock.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "measure/protocol/protocol.hpp"
#include "tests/unit/measure/fake_suite.hpp"
#include "tests/unit/measure_run/scripted_prepared.hpp"

namespace triptych::measure {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double millisecond = 1e6;

record::ClockTrust verdict_on(const ScriptedPrepared::Script& script) {
  ScriptedPrepared prepared(script);
  return calibrate(prepared, technique::Work::compute);
}

record::ClockTrust verdict_on_ratio(double ratio) {
  return verdict_on([=](int) { return frame_of(30 * millisecond, ratio * 30 * millisecond); });
}

TEST(Calibrate, TrustsExactClocksAndClocksThatOmitTheLaunch) {
  for (const double ratio : {1.0, 0.98, 0.91, 1.01}) {
    const record::ClockTrust trust = verdict_on_ratio(ratio);
    EXPECT_TRUE(trust.offered && trust.trusted) << trust.verdict;
    EXPECT_NEAR(trust.ratio, ratio, 1e-12);
    EXPECT_EQ(trust.work, "compute");
    EXPECT_THAT(trust.verdict, StartsWith("trusted: "));
  }
}

TEST(Calibrate, RejectsClocksThatAreTooSlowOrTooFast) {
  for (const double ratio : {0.0, 0.14, 0.85, 1.05, 3.0, -1.0}) {
    const record::ClockTrust trust = verdict_on_ratio(ratio);
    EXPECT_TRUE(trust.offered);
    EXPECT_FALSE(trust.trusted) << trust.verdict;
    EXPECT_THAT(trust.verdict, StartsWith("not trusted: "));
  }
  EXPECT_THAT(verdict_on_ratio(0).verdict, HasSubstr("measured 0 ns"));
}

TEST(Calibrate, RejectsAClockThatJitters) {
  const auto trust = verdict_on([](int n) {
    return frame_of(30 * millisecond, (n % 2 == 0 ? 0.5 : 0.99) * 30 * millisecond);
  });
  EXPECT_FALSE(trust.trusted);
  EXPECT_NEAR(trust.ratio_low, 0.5, 1e-12);
  EXPECT_NEAR(trust.ratio_high, 0.99, 1e-12);
}

TEST(Calibrate, ToleratesOneLateWakeUpButNoOtherOutlier) {
  const auto plausible_with_one_outlier = [](double wall_ms, double device_ms) {
    return verdict_on([=](int n) {
             return n == 5 ? frame_of(wall_ms * millisecond, device_ms * millisecond)
                           : frame_of(30 * millisecond, 29.8 * millisecond);
           })
        .trusted;
  };
  EXPECT_TRUE(plausible_with_one_outlier(38, 29.8));
  EXPECT_FALSE(plausible_with_one_outlier(30, 35));
  EXPECT_FALSE(plausible_with_one_outlier(30, 0));
}

TEST(Calibrate, ReportsADeviceWithoutTimes) {
  const auto trust = verdict_on([](int) { return frame_of(30 * millisecond); });
  EXPECT_FALSE(trust.offered);
  EXPECT_FALSE(trust.trusted);
  EXPECT_THAT(trust.verdict, HasSubstr("reports no frame times"));
}

TEST(Calibrate, HandlesTimesThatAreNotNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(verdict_on([=](int) { return frame_of(30 * millisecond, nan); }).trusted);
  EXPECT_FALSE(verdict_on([=](int) { return frame_of(nan, 30 * millisecond); }).trusted);
  EXPECT_FALSE(verdict_on([](int) { return frame_of(0, 0); }).trusted);
}

TEST(Calibrate, NeedsFewerFramesIfTheyAreLong) {
  ScriptedPrepared prepared = steady(900 * millisecond, 899 * millisecond);
  EXPECT_TRUE(calibrate(prepared, technique::Work::draw).trusted);
  EXPECT_LE(std::ranges::count(prepared.calls, "timing"), 5);
}

TEST(Plausible, NeedsATimePerFrameAboveZeroAndWithinTheWallTime) {
  EXPECT_TRUE(plausible({1 * millisecond, 2 * millisecond}, {1.1 * millisecond, 2 * millisecond}));
  // The device time exceeds the wall time by less than the clock resolution.
  EXPECT_TRUE(plausible({5e3}, {4e3}));
  EXPECT_FALSE(plausible({}, {}));
  EXPECT_FALSE(plausible({1 * millisecond}, {1 * millisecond, 1 * millisecond}));
  EXPECT_FALSE(plausible({0}, {1 * millisecond}));
  EXPECT_FALSE(plausible({1.1 * millisecond}, {1 * millisecond}));
}

TEST(Plausible, ToleratesLaunchesAndLateWakeUpsButNotMissingWork) {
  EXPECT_TRUE(plausible({0.05 * millisecond}, {0.3 * millisecond}));  // a launch may take this long
  EXPECT_FALSE(plausible({0.05 * millisecond},
                         // No launch takes this long, so work is missing from the device time.
                         {1.3 * millisecond}));
  const std::vector<double> wall_ns(8, 30 * millisecond);
  std::vector<double> device_ns(8, 29 * millisecond);
  device_ns[2] = device_ns[5] = 5 * millisecond;
  EXPECT_TRUE(plausible(device_ns, wall_ns));
  device_ns[6] = 5 * millisecond;
  EXPECT_FALSE(plausible(device_ns, wall_ns));
}

// A device whose frames take 0.1 ms divided by the step size, so frames with a finer step take
// longer.
class GrowingDevice final : public Device {
 public:
  explicit GrowingDevice(double finest_step) : finest_step_(finest_step) {}
  const record::Device& info() const override { return info_; }
  std::optional<std::string> unsupported(const measure::Work& work) const override {
    const double step = std::get<VolumeWork>(work.scene).scene.step_voxels;
    if (step < finest_step_) return "too many samples";
    return std::nullopt;
  }
  VolumePath default_path(const VolumeKind&) const override { return {}; }
  double filter_weight_error(const VolumePath&) const override { return 0; }
  std::unique_ptr<Prepared> prepare(const measure::Work& work) override {
    const double step = std::get<VolumeWork>(work.scene).scene.step_voxels;
    longest_ns = 0.1 * millisecond / step;
    return std::make_unique<ScriptedPrepared>(
        // The wall time includes 30 µs for the launch, which the device clock does not measure.
        [ns = longest_ns](int) { return frame_of(ns + 3e4, ns); });
  }
  double longest_ns = 0;

 private:
  record::Device info_;
  double finest_step_;
};

TEST(CalibrateClock, LengthensFramesUntilTheLaunchNoLongerMatters) {
  FakeSuite suite;
  GrowingDevice device(0);
  const record::ClockTrust trust = calibrate_clock(device, suite, technique::Work::compute);
  EXPECT_TRUE(trust.trusted) << trust.verdict;
  EXPECT_GE(device.longest_ns, ClockLimits::least_frame_ns);
}

TEST(CalibrateClock, ReportsThatFramesAreTooShort) {
  FakeSuite suite;
  GrowingDevice device(1);
  const record::ClockTrust trust = calibrate_clock(device, suite, technique::Work::compute);
  EXPECT_FALSE(trust.trusted);
  EXPECT_THAT(trust.verdict, HasSubstr("frames this short are inconclusive"));
}

TEST(CalibrateClock, ReportsWhyAKindOfWorkCannotBeCalibrated) {
  FakeSuite suite;
  GrowingDevice device(2);
  const record::ClockTrust trust = calibrate_clock(device, suite, technique::Work::draw);
  EXPECT_FALSE(trust.offered);
  EXPECT_EQ(trust.verdict, "not calibrated: too many samples");
}

}  // namespace
}  // namespace triptych::measure
