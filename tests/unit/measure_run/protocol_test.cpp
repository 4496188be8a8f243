#include "measure/protocol/protocol.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/json.hpp"
#include "record/benchmark_entries.hpp"
#include "tests/unit/measure_run/scripted_prepared.hpp"

namespace triptych::measure {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<record::ClockTrust> trusting(technique::Work kind) {
  record::ClockTrust trust;
  trust.work = technique::name_of(kind);
  trust.offered = true;
  trust.trusted = true;
  trust.ratio = 1;
  return {trust};
}

Measurement measured(Prepared& prepared, const Protocol& protocol = {},
                     const std::vector<record::ClockTrust>& clocks = {}) {
  return measure(prepared, protocol, technique::Work::compute, clocks, "test");
}

std::vector<std::string> repeated(const std::string& call, int times) {
  return std::vector<std::string>(static_cast<std::size_t>(times), call);
}

TEST(Protocol, CallsAreInTheOrderOfThePaper) {
  ScriptedPrepared prepared = steady(50 * ms);
  static_cast<void>(measured(prepared));
  std::erase(prepared.calls, "image");
  std::vector<std::string> expected = repeated("timing", 4 + 8);
  expected.insert(expected.end(), {"statistics", "counters", "timing", "timing"});
  EXPECT_EQ(prepared.calls, expected);
}

TEST(Protocol, LongFramesNeedMinimalWarmUpAndOneLoopFrame) {
  ScriptedPrepared prepared = steady(300 * ms);
  const record::Record record = measured(prepared).record;
  EXPECT_EQ(record.warm_up_frames, 4);
  EXPECT_EQ(record.frames_per_100ms, 1);
  EXPECT_EQ(record.loop_frames, 1);
  EXPECT_EQ(std::ranges::count(prepared.calls, "timing"), 4 + 8 + 1);
}

TEST(Protocol, ShortFramesWarmUpForATenthOfTheLoop) {
  ScriptedPrepared prepared = steady(1 * ms);
  const record::Record record = measured(prepared).record;
  EXPECT_EQ(record.warm_up_frames, 10);
  EXPECT_EQ(record.frames_per_100ms, 100);
  EXPECT_EQ(record.loop_frames, 100);
}

TEST(Protocol, TheFastestWarmUpFramePredictsTheLoop) {
  // The first frame is slow, because the device is cold. 15 frames of 7 ms fill 100 ms.
  ScriptedPrepared prepared([](int n) { return frame_of(n == 0 ? 900 * ms : 7 * ms); });
  EXPECT_EQ(measured(prepared).record.frames_per_100ms, 15);
}

TEST(Protocol, AClockTooCoarseForAFrameIsBounded) {
  ScriptedPrepared prepared = steady(0);
  const record::Record record = measured(prepared, {.most_loop_frames = 20}).record;
  EXPECT_EQ(record.loop_frames, 20);
  EXPECT_LE(record.warm_up_frames, 20);
}

TEST(Protocol, TheLoopHasItsOwnLength) {
  ScriptedPrepared prepared = steady(10 * ms);
  const record::Record record = measured(prepared, {.least_loop_ns = 30 * ms}).record;
  EXPECT_EQ(record.frames_per_100ms, 10);
  EXPECT_EQ(record.loop_frames, 3);
  EXPECT_GT(record.loop_wall_ns, 0);
}

TEST(Protocol, RawTimesAreUnchanged) {
  ScriptedPrepared prepared([](int n) { return frame_of(50 * ms + n / 3.0, 49 * ms + n / 7.0); });
  const record::Record record = measured(prepared, {}, trusting(technique::Work::compute)).record;
  ASSERT_EQ(record.wall_ns.size(), 8U);
  ASSERT_EQ(record.device_ns.size(), 8U);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(record.wall_ns[static_cast<std::size_t>(i)], 50 * ms + (4 + i) / 3.0);
    EXPECT_EQ(record.device_ns[static_cast<std::size_t>(i)], 49 * ms + (4 + i) / 7.0);
  }
  EXPECT_EQ(record.clock(), "device");
}

TEST(Protocol, TheImageIsFromTheLastTimedFrame) {
  ScriptedPrepared prepared = steady(50 * ms);
  const Measurement result = measured(prepared);
  EXPECT_EQ(result.image.rgba[0], 1.0F);
  EXPECT_EQ(result.record.image, image_hash(result.image));
}

TEST(Protocol, CountsComeFromTheirOwnFramesAndAreOptional) {
  ScriptedPrepared prepared = steady(50 * ms);
  const record::Record with = measured(prepared).record;
  EXPECT_EQ(with.counters, (record::Counts{{"rays_hit", 64}, {"samples", 512}}));
  EXPECT_EQ(with.statistics, (record::Counts{{"compute_invocations", 64}}));
  ScriptedPrepared bare = steady(50 * ms);
  const record::Record without = measured(bare, {.statistics = false, .counters = false}).record;
  EXPECT_THAT(without.counters, IsEmpty());
  EXPECT_THAT(without.statistics, IsEmpty());
  EXPECT_EQ(std::ranges::count(bare.calls, "counters"), 0);
}

TEST(Protocol, UntimedRunsDrawThreeFrames) {
  ScriptedPrepared prepared = steady(50 * ms);
  const Measurement result = measured(prepared, {.statistics = false, .timed = false});
  std::erase(prepared.calls, "image");
  EXPECT_EQ(prepared.calls, (std::vector<std::string>{"timing", "counters", "timing"}));
  EXPECT_EQ(result.record.outcome, record::Outcome::measured);
  EXPECT_EQ(result.record.image, image_hash(result.image));
  EXPECT_EQ(result.record.counters, (record::Counts{{"rays_hit", 64}, {"samples", 512}}));
  EXPECT_THAT(result.record.time_ns(), IsEmpty());
  EXPECT_THAT(result.record.statistics, IsEmpty());
}

TEST(Protocol, OneMissingDeviceTimeDiscardsAllDeviceTimes) {
  ScriptedPrepared prepared(
      [](int n) { return n == 9 ? frame_of(50 * ms) : frame_of(50 * ms, 49 * ms); });
  const record::Record record = measured(prepared, {}, trusting(technique::Work::compute)).record;
  EXPECT_THAT(record.device_ns, IsEmpty());
  EXPECT_EQ(record.clock(), "wall");
}

TEST(Protocol, AClockIsTrustedOnlyForTheKindItWasCalibratedFor) {
  ScriptedPrepared prepared = steady(50 * ms, 49 * ms);
  const record::Record record = measured(prepared, {}, trusting(technique::Work::draw)).record;
  EXPECT_FALSE(record.device_clock_trusted);
  EXPECT_THAT(record.device_ns, Each(49 * ms));  // recorded nevertheless
}

TEST(Protocol, ATrustedClockWithImpossibleTimesIsRejected) {
  for (const double device_ns : {0.0, 60 * ms, std::numeric_limits<double>::quiet_NaN()}) {
    ScriptedPrepared prepared(
        [=](int n) { return frame_of(50 * ms, n == 6 ? device_ns : 49 * ms); });
    EXPECT_EQ(measured(prepared, {}, trusting(technique::Work::compute)).record.clock(), "wall")
        << device_ns;
  }
}

TEST(Protocol, ATrustedClockThatOmitsWorkIsRejected) {
  ScriptedPrepared prepared = steady(28 * ms, 0.009 * ms);
  const record::Record record = measured(prepared, {}, trusting(technique::Work::compute)).record;
  EXPECT_EQ(record.clock(), "wall");
  EXPECT_THAT(record.device_ns, Each(0.009 * ms));
  EXPECT_EQ(
      record::unpack_benchmark_entries(record.benchmark_json).at(0).at("device_clock_trusted"), 0);
}

TEST(Protocol, ErrorsOfFramesAreRethrown) {
  // The failing frame is a warm-up frame, a timed frame, or the frame for the counters.
  for (const int failing : {2, 7, 13}) {
    ScriptedPrepared prepared([=](int n) {
      if (n == failing) throw core::ApiError("vkQueueSubmit", "VK_ERROR_UNKNOWN");
      return frame_of(50 * ms);
    });
    EXPECT_THROW(static_cast<void>(measured(prepared)), core::ApiError) << failing;
    std::erase(prepared.calls, "image");
    EXPECT_EQ(prepared.calls.size(), static_cast<std::size_t>(failing) + 1);
  }
}

TEST(Protocol, BenchmarkEntriesCarrySamplesStatisticsAndCountsAsFlatKeys) {
  ScriptedPrepared prepared([](int n) { return frame_of((50 + n) * ms, (49 + n) * ms); });
  const record::Record record = measured(prepared, {}, trusting(technique::Work::compute)).record;
  const auto entries = record::unpack_benchmark_entries(record.benchmark_json);
  ASSERT_TRUE(entries.is_array());
  std::vector<double> samples;
  for (const auto& entry : entries) {
    for (const char* key : {"name", "run_name", "run_type", "repetitions", "threads", "iterations",
                            "real_time", "cpu_time", "time_unit"}) {
      EXPECT_TRUE(entry.contains(key)) << key << " in " << entry;
    }
    for (const auto& value : entry) EXPECT_FALSE(value.is_structured()) << entry;
    const bool loop = entry.at("name").get<std::string>().starts_with("test/loop");
    if (entry.at("run_type") == "iteration" && !loop) {
      samples.push_back(entry.at("real_time"));
      EXPECT_EQ(entry.at("samples"), 512);
      EXPECT_NEAR(entry.at("device_ns").get<double>(),
                  (52.0 + static_cast<double>(samples.size())) * ms, 1);
      EXPECT_EQ(entry.at("device_clock_trusted"), 1);
    }
    if (entry.value("aggregate_name", "") == "median") {
      EXPECT_NEAR(entry.at("real_time").get<double>(), 57.5 * ms, 1);
    }
    if (entry.value("aggregate_name", "") == "min") {
      EXPECT_NEAR(entry.at("real_time").get<double>(), 54 * ms, 1);
    }
  }
  // The samples are the wall times from the fifth frame on, because the first four frames are
  // warm-up frames. Frame n (zero-based) takes 50 + n ms.
  ASSERT_EQ(samples.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(samples[i], (54.0 + static_cast<double>(i)) * ms, 1);
  }
}

TEST(Protocol, OverheadExcludesTheFrames) {
  ScriptedPrepared prepared = steady(50 * ms);
  const double overhead_ns = measured(prepared).record.overhead_ns;
  EXPECT_GE(overhead_ns, 0);
  EXPECT_LT(overhead_ns, 1e9);
}

TEST(ImageHash, DistinguishesBitsSizesAndPlanes) {
  core::Image image(2, 1);
  const std::string hash = image_hash(image);
  core::Image turned(1, 2);
  EXPECT_NE(image_hash(turned), hash);
  core::Image signed_zero = image;
  signed_zero.rgba[3] = -0.0F;
  EXPECT_NE(image_hash(signed_zero), hash);
  core::Image deep = image;
  deep.depth = {1, 1};
  EXPECT_NE(image_hash(deep), hash);
  EXPECT_EQ(image_hash(core::Image(2, 1)), hash);
}

}  // namespace
}  // namespace triptych::measure
