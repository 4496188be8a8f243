#include "record/record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "core/json.hpp"
#include "samples.hpp"

namespace triptych::record {
namespace {

using core::Json;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

// Statistics of samples

TEST(Percentile, InterpolatesBetweenOrderStatistics) {
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0), 1);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 1), 4);
  EXPECT_DOUBLE_EQ(percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(percentile({10, 20}, 0.25), 12.5);
  EXPECT_EQ(percentile({7}, 0.9), 7);
  EXPECT_EQ(percentile({1, inf}, 0), 1);
}

TEST(Percentile, IgnoresNaN) {
  EXPECT_EQ(percentile({nan, 5, nan, 7}, 0.5), 6);
  EXPECT_TRUE(std::isnan(percentile({nan}, 0.5)));
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

TEST(Summarise, QuartilesOrNothing) {
  const auto summary = summarise({5, 1, 2, 4, 3});
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->minimum, 1);
  EXPECT_EQ(summary->lower_quartile, 2);
  EXPECT_EQ(summary->median, 3);
  EXPECT_EQ(summary->upper_quartile, 4);
  EXPECT_EQ(summary->maximum, 5);
  EXPECT_FALSE(summarise({}));
  EXPECT_FALSE(summarise({nan, nan}));
}

// Clocks and names

TEST(RecordTest, DeviceTimeIsUsedOnlyIfTrustedAndPresent) {
  Record record = sample_record();
  EXPECT_EQ(record.clock(), "device");
  EXPECT_EQ(record.time_ns(), record.device_ns);
  record.device_clock_trusted = false;
  EXPECT_EQ(record.clock(), "wall");
  EXPECT_EQ(record.time_ns(), record.wall_ns);
  record.device_clock_trusted = true;
  record.device_ns.clear();
  EXPECT_EQ(record.clock(), "wall");
  EXPECT_EQ(record.time_ns(), record.wall_ns);
}

TEST(RecordTest, InstructionsExcludeUnrepeatableParts) {
  Record record;
  EXPECT_FALSE(record.instructions());
  EXPECT_FALSE(record.fetched_bytes());
  record.cost = {{"device_code", 70}, {"driver", 7}, {"libc", 900}, {"misses", 3}};
  EXPECT_EQ(record.instructions(), 77U);
  EXPECT_EQ(record.fetched_bytes(), 192U);
}

TEST(RecordTest, TestIdsUseOnlyAllowedCharacters) {
  Record record = sample_record();
  record.suite = "volume";
  record.plan = "volume/quick";
  record.device = "vulkan:lavapipe";
  EXPECT_EQ(record.test_id("image"), "volume.quick.image.vulkan:lavapipe");
  record.plan = "My Plan";
  record.device = "opencl:PoCL#2";
  EXPECT_EQ(record.test_id("timing"), "volume.my_plan.timing.opencl:pocl_2");
  EXPECT_THAT(record.test_id("a\"b\n"), MatchesRegex("[a-z0-9_.:-]+"));
}

TEST(RunTest, APlanFromAFileIsMeasuredFromAFileAgain) {
  EXPECT_EQ(plan_argument("volume/quick"), "volume/quick");
  EXPECT_EQ(plan_argument("mine"), "FOLDER/mine.yaml");
}

TEST(OutcomeTest, NamesRoundTrip) {
  for (const Outcome each : {Outcome::measured, Outcome::skipped, Outcome::failed, Outcome::crashed,
                             Outcome::hung, Outcome::lost}) {
    EXPECT_EQ(outcome(name_of(each)), each);
  }
  EXPECT_THROW(static_cast<void>(outcome("broken")), core::InputError);
}

TEST(DeviceTest, TheKeyCoversEverythingThatAffectsTimings) {
  const Device device = sample_device();
  std::set<std::string> keys{device.key()};
  std::set<std::string> hashes{device.key_hash()};
  const auto add = [&](auto change) {
    Device other = device;
    change(other);
    keys.insert(other.key());
    hashes.insert(other.key_hash());
  };
  add([](Device& d) { d.id += "#2"; });
  add([](Device& d) { d.driver_version += "x"; });
  add([](Device& d) { d.api_version += "x"; });
  add([](Device& d) { d.cpu_features += ",avx512"; });
  add([](Device& d) { d.environment["LP_NUM_THREADS"] = "1"; });
  add([](Device& d) { d.environment["GALLIVM_PERF"] = ""; });
  add([](Device& d) { d.environment.clear(); });
  add([](Device& d) {  // a field must not imitate another part of the key
    d.api_version += "; CPU " + d.cpu_features;
    d.cpu_features.clear();
  });
  EXPECT_EQ(keys.size(), 9U);
  EXPECT_EQ(hashes.size(), 9U);

  Device other = device;
  other.limits["max_image_3d"] = "1";
  other.name = "as marketed";
  other.statistics_calibration.clear();
  EXPECT_EQ(other.key(), device.key());
}

// One driver can serve many graphics cards, so the key of a device must contain the name of the
// card.
TEST(DeviceTest, HardwareIsIdentifiedByItsName) {
  Device device = sample_device("vulkan:nvidia");
  device.cpu_features.clear();
  device.name = "Board 1";
  Device other = device;
  other.name = "Board 2";
  EXPECT_NE(other.key(), device.key());
  EXPECT_THAT(device.key(), HasSubstr("; GPU Board 1"));
}

TEST(DeviceTest, KeysAreValidLinesAndFileNames) {
  Device device = sample_device("vulkan:lavapipe");
  device.driver_version = "Mesa 22.3.6\n(LLVM/15)";
  EXPECT_THAT(device.key(), ::testing::Not(HasSubstr("\n")));
  EXPECT_THAT(device.key_hash(), MatchesRegex("vulkan-lavapipe-[0-9a-f]+"));
  EXPECT_THAT(device.statistics_key(),
              MatchesRegex("vulkan-lavapipe-mesa-22.3.6-llvm-15-[0-9a-f]+"));
}

TEST(DeviceTest, TheStatisticsKeyCoversOnlyIdAndDriver) {
  const Device device = sample_device();
  Device other = device;
  other.environment.clear();
  other.cpu_features = "none";
  other.statistics_calibration.clear();
  EXPECT_EQ(other.statistics_key(), device.statistics_key());
  // Earlier versions replaced the parentheses, spaces and hyphens of a driver version by the same
  // character, so both driver versions had the same file name.
  other.driver_version = "1.2 LLVM-15";
  EXPECT_NE(other.statistics_key(), device.statistics_key());
}

// JSON

template <typename T>
Json round_trip(const T& value) {
  return Json(Json::parse(Json(value).dump()).get<T>());
}

TEST(RecordJson, EveryFieldRoundTrips) {
  EXPECT_EQ(round_trip(sample_record()), Json(sample_record()));
  EXPECT_EQ(Json(sample_record()).size(), 35U) << "add the new field to sample_record()";
  EXPECT_EQ(Json::parse(Json(sample_device()).dump()).get<Device>(), sample_device());
  EXPECT_EQ(Json::parse(Json(sample_clock()).dump()).get<ClockTrust>(), sample_clock());
  EXPECT_EQ(round_trip(sample_run()), Json(sample_run()));
  EXPECT_EQ(Json(sample_record()).get<Record>().counters, sample_record().counters);
}

TEST(RecordJson, NaNAndInfinityRoundTrip) {
  Record record = sample_record();
  record.wall_ns = {nan, inf, -inf, 1};
  record.precision["filter_weight_error"] = nan;
  const Record back = Json::parse(Json(record).dump()).get<Record>();
  ASSERT_EQ(back.wall_ns.size(), 4U);
  EXPECT_TRUE(std::isnan(back.wall_ns[0]));
  EXPECT_EQ(back.wall_ns[1], inf);
  EXPECT_EQ(back.wall_ns[2], -inf);
  EXPECT_EQ(back.wall_ns[3], 1);
  EXPECT_TRUE(std::isnan(back.precision.at("filter_weight_error")));
}

TEST(RecordJson, InvalidUtf8IsReplaced) {
  Device device = sample_device();
  device.name = "caf\xe9";
  device.limits["\xff"] = "\xfe";
  EXPECT_NO_THROW({
    const auto back = Json::parse(Json(device).dump()).get<Device>();
    EXPECT_EQ(back.name, "caf\xef\xbf\xbd");
  });
}

TEST(RecordJson, WrongTypesAreReportedByName) {
  const auto refusal = [](const char* name, const Json& value) {
    Json json = sample_record();
    json[name] = value;
    try {
      static_cast<void>(json.get<Record>());
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string("was accepted");
  };
  EXPECT_THAT(refusal("wall_ns", "fast"), HasSubstr("'wall_ns': expected a list"));
  EXPECT_THAT(refusal("wall_ns", {1, "fast"}), HasSubstr("expected a number"));
  EXPECT_THAT(refusal("reason", 1), HasSubstr("'reason': expected an object"));
  EXPECT_THAT(refusal("loop_frames", -1), HasSubstr("whole number"));
  EXPECT_THAT(refusal("loop_frames", 1e10), HasSubstr("whole number"));
  EXPECT_THAT(refusal("loop_frames", 5'000'000'000), HasSubstr("whole number"));
  EXPECT_THAT(refusal("device_clock_trusted", 1), HasSubstr("true or false"));
  EXPECT_THAT(refusal("outcome", "good"), HasSubstr("unknown outcome 'good'"));
  EXPECT_THROW(static_cast<void>(Json::array().get<Record>()), core::InputError);
}

TEST(RecordJson, MissingKeysKeepTheirDefaults) {
  const auto record = Json::object().get<Record>();
  EXPECT_EQ(record.outcome, Outcome::failed);
  EXPECT_TRUE(record.wall_ns.empty());
}

}  // namespace
}  // namespace triptych::record
