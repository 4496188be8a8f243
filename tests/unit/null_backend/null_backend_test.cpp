#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include "backends/null/backend.hpp"
#include "core/error.hpp"
#include "core/image_io.hpp"

namespace triptych::null_backend {
namespace {

using measure::Purpose;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

measure::VolumeWork volume(const std::string& data = "cube") {
  auto grid = std::make_shared<scene::VoxelGrid>();
  grid->name = data;
  grid->size = {4, 8, 2};
  measure::VolumeWork work;
  work.scene.grid = std::move(grid);
  work.scene.width = 16;
  work.scene.height = 8;
  work.scene.step_voxels = 0.5;
  return work;
}

measure::Work work(const measure::VolumeWork& scene = volume(),
                   const std::string& technique = "raycast") {
  return {.technique = technique, .scene = scene};
}

std::unique_ptr<measure::Device> device(const Script& script,
                                        std::string_view id = "null:scripted") {
  return make_backend(script)->open(id);
}

std::vector<double> times(const Script& script, int frames, const measure::Work& what = work(),
                          std::string_view id = "null:scripted") {
  const auto opened = device(script, id);
  const auto prepared = opened->prepare(what);
  std::vector<double> result;
  for (int i = 0; i < frames; ++i) result.push_back(prepared->frame(Purpose::timing).wall_ns);
  return result;
}

core::Image image(const Script& script, const measure::Work& what) {
  const auto opened = device(script);
  const auto prepared = opened->prepare(what);
  static_cast<void>(prepared->frame(Purpose::timing));
  return prepared->image();
}

// Listing

class NullEnvironment : public ::testing::Test {
 protected:
  ~NullEnvironment() override { unsetenv("TRIPTYCH_NULL_SCRIPT"); }
  static void script(const char* json) { setenv("TRIPTYCH_NULL_SCRIPT", json, 1); }
};

TEST_F(NullEnvironment, OrdinaryRunsShowNoNullDevice) {
  unsetenv("TRIPTYCH_NULL_SCRIPT");
  const auto backend = make_backend();
  EXPECT_EQ(backend->api(), "null");
  EXPECT_THAT(backend->list().devices, IsEmpty());
  EXPECT_THAT(backend->list().broken, IsEmpty());
  EXPECT_THROW(static_cast<void>(backend->open("null:scripted")), core::NotSupported);
}

TEST_F(NullEnvironment, ScriptMakesDevices) {
  script(R"({"devices": [1, 2], "driver_version": "7"})");
  const auto backend = make_backend();
  const measure::Listing listing = backend->list();
  ASSERT_THAT(listing.devices, SizeIs(2));
  EXPECT_EQ(listing.devices[0].id, "null:scripted");
  EXPECT_EQ(listing.devices[1].id, "null:scripted#2");
  EXPECT_EQ(listing.devices[1].driver_version, "7");
  EXPECT_EQ(backend->open("null:scripted#2")->info(), listing.devices[1]);
  EXPECT_THROW(static_cast<void>(backend->open("null:scripted#3")), core::NotSupported);
}

TEST_F(NullEnvironment, AnInvalidScriptIsReportedAsBroken) {
  script("{\"seed\": -1}");
  const auto backend = make_backend();
  ASSERT_THAT(backend->list().broken, SizeIs(1));
  EXPECT_THAT(backend->list().broken[0].reason, HasSubstr("'seed'"));
  EXPECT_THROW(static_cast<void>(backend->open("null:scripted")), core::InputError);
}

TEST(NullScript, AllKeys) {
  const Script script = parse_script(
      R"({"seed": 3, "devices": [1, 1.5], "driver_version": "2", "base_ns": 10,
          "ns_per_sample": 0, "warm_up_factor": 2, "prepare_factors": [3, 2], "noise": 0.1, "outlier_share": 0.2,
          "outlier_factor": 4, "device_over_wall": null, "counts": false, "sleep": true, "factors": {"*skip=none*": 1.5},
          "filter_weight_error": 0.5, "images": {"*": "x.exr"},
          "leaks": {"*ball*": 4096}, "caches": {"*": 100},
          "failures": [{"kind": "hang", "at": "prepare", "only": "*ball*"},
                       {"kind": "crash", "frame": 2}, {"kind": "nan_image"}]})");
  EXPECT_EQ(script.seed, 3U);
  EXPECT_THAT(script.devices, ElementsAre(1, 1.5));
  EXPECT_EQ(script.base_ns, 10);
  EXPECT_EQ(script.ns_per_sample, 0);
  EXPECT_THAT(script.prepare_factors, ElementsAre(3, 2));
  EXPECT_EQ(script.outlier_factor, 4);
  ASSERT_EQ(script.factors.size(), 1U);
  EXPECT_EQ(script.factors[0].first, "*skip=none*");
  EXPECT_EQ(script.factors[0].second, 1.5);
  ASSERT_THAT(script.leaks, SizeIs(1));
  EXPECT_EQ(script.leaks[0].first, "*ball*");
  EXPECT_EQ(script.leaks[0].second, 4096);
  ASSERT_THAT(script.caches, SizeIs(1));
  EXPECT_EQ(script.caches[0].second, 100);
  EXPECT_FALSE(script.device_over_wall);
  EXPECT_FALSE(script.counts);
  EXPECT_TRUE(script.sleep);
  ASSERT_THAT(script.failures, SizeIs(3));
  EXPECT_EQ(script.failures[0].kind, FailureKind::hang);
  EXPECT_EQ(script.failures[0].at, Place::prepare);
  EXPECT_EQ(script.failures[0].only, "*ball*");
  EXPECT_EQ(script.failures[1].at, Place::frame);
  EXPECT_EQ(script.failures[1].frame, 2);
  EXPECT_EQ(script.failures[2].at, Place::image);
  EXPECT_EQ(parse_script("{}").device_over_wall, Script().device_over_wall);
}

TEST(NullScript, MistakesAreReported) {
  for (const auto& [json, named] : std::vector<std::pair<const char*, const char*>>{
           {"", "JSON object"},
           {"[1]", "JSON object"},
           {R"({"speed": 1})", "'speed'"},
           {R"({"noise": -1})", "'noise'"},
           {R"({"noise": "much"})", "'noise'"},
           {R"({"devices": []})", "'devices'"},
           {R"({"counts": 1})", "'counts'"},
           {R"({"failures": [{}]})", "'failures'"},
           {R"({"failures": [{"kind": "sulk"}]})", "crash, exit"},
           {R"({"failures": [{"kind": "crash", "at": "home"}]})", "open, supports"},
           {R"({"failures": [{"kind": "crash", "where": "frame"}]})", "'where'"},
           {R"({"failures": [{"kind": "nan_image", "at": "frame"}]})", "'at'"}}) {
    try {
      static_cast<void>(parse_script(json));
      ADD_FAILURE() << json << " was accepted";
    } catch (const core::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(named)) << json;
    }
  }
}

// Times

TEST(NullTime, IsComputedFromTheWork) {
  const Script script{.devices = {1, 2}, .base_ns = 100, .ns_per_sample = 1};
  // The image has 16 × 8 pixels, the longest edge has 8 voxels, and each voxel is sampled twice.
  EXPECT_THAT(times(script, 3), Each(100 + 16 * 8 * 8 * 2));
  EXPECT_THAT(times(script, 3, work(), "null:scripted#2"), Each(2 * (100 + 16 * 8 * 8 * 2)));
  measure::VolumeWork slowed = volume();
  slowed.options.extra_work_stride = 10;
  EXPECT_NEAR(times(script, 1, work(slowed))[0] / times(script, 1)[0], 1.1, 1e-12);
}

TEST(NullTime, WarmUpFactorAppliesToTheFirstFrame) {
  const Script script{.base_ns = 100, .ns_per_sample = 0, .warm_up_factor = 5};
  EXPECT_THAT(times(script, 3), ElementsAre(500, 100, 100));
}

TEST(NullTime, PrepareFactorsApplyToEachWork) {
  const auto backend =
      make_backend(Script{.base_ns = 100, .ns_per_sample = 0, .prepare_factors = {3, 2}});
  const auto device = backend->open("null:scripted");
  const auto next_ns = [&device](const measure::Work& what) {
    return device->prepare(what)->frame(measure::Purpose::timing).wall_ns;
  };
  EXPECT_EQ(next_ns(work()), 300);
  EXPECT_EQ(next_ns(work()), 200);
  measure::VolumeWork other = volume();
  other.options.extra_work_stride = 10;
  EXPECT_NEAR(next_ns(work(other)), 330, 1e-9);
  EXPECT_EQ(next_ns(work()), 100);
}

TEST(NullTime, NoiseIsInjectedAndSeeded) {
  Script script{.base_ns = 1000, .ns_per_sample = 0, .noise = 0.05};
  const std::vector<double> first = times(script, 4000);
  EXPECT_EQ(times(script, 4000), first) << "the same seed, the same times";
  script.seed = 2;
  EXPECT_NE(times(script, 4000), first);
  const double mean = std::accumulate(first.begin(), first.end(), 0.0) / 4000;
  double variance = 0;
  for (const double each : first) variance += (each - mean) * (each - mean) / 4000;
  EXPECT_NEAR(mean, 1000, 3);
  EXPECT_NEAR(std::sqrt(variance), 50, 2.5);
}

TEST(NullTime, OutliersHaveTheRequestedFrequency) {
  const Script script{
      .base_ns = 1000, .ns_per_sample = 0, .outlier_share = 0.1, .outlier_factor = 3};
  const auto all = times(script, 2000);
  const auto outliers = std::ranges::count(all, 3000.0);
  EXPECT_NEAR(static_cast<double>(outliers), 200, 45);
  EXPECT_EQ(std::ranges::count(all, 1000.0), 2000 - outliers);
}

TEST(NullTime, DeviceTimeFollowsTheScript) {
  for (const std::optional<double> ratio : {std::optional<double>(0.98), {0.0}, {3.0}, {}}) {
    const auto opened = device({.device_over_wall = ratio});
    const auto prepared = opened->prepare(work());
    const measure::Frame frame = prepared->frame(Purpose::timing);
    ASSERT_EQ(frame.device_ns.has_value(), ratio.has_value());
    if (ratio) {
      EXPECT_DOUBLE_EQ(*frame.device_ns, *ratio * frame.wall_ns);
    }
    EXPECT_FALSE(prepared->frame(Purpose::counters).device_ns);
    EXPECT_FALSE(prepared->frame(Purpose::statistics).device_ns);
  }
}

TEST(NullTime, SleepTakesTheReportedTime) {
  const auto start = std::chrono::steady_clock::now();
  static_cast<void>(times({.base_ns = 2e7, .ns_per_sample = 0, .sleep = true}, 2));
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(40));
}

// Counts and images

TEST(NullCounts, AreReportedPerPurposeOrNotAtAll) {
  const auto opened = device({});
  const auto prepared = opened->prepare(work());
  EXPECT_THAT(prepared->frame(Purpose::timing).counts, IsEmpty());
  const record::Counts counters = prepared->frame(Purpose::counters).counts;
  EXPECT_EQ(counters.at("samples"), 16U * 8 * 8 * 2);
  for (const std::string_view name : technique::raycast_counters) {
    EXPECT_TRUE(counters.contains(std::string(name))) << name;
  }
  EXPECT_EQ(prepared->frame(Purpose::statistics).counts.at("compute_invocations"), 128U);
  const auto drawn = opened->prepare(work(volume(), "raycast_fragment"));
  EXPECT_EQ(drawn->frame(Purpose::statistics).counts.at("fragment_invocations"), 128U);

  const auto silent = device({.counts = false})->prepare(work());
  EXPECT_THAT(silent->frame(Purpose::counters).counts, IsEmpty());
  EXPECT_THAT(silent->frame(Purpose::statistics).counts, IsEmpty());
}

TEST(NullImage, DependsOnTheSceneAlone) {
  const core::Image plain = image({}, work());
  EXPECT_EQ(plain.width, 16);
  EXPECT_EQ(plain.height, 8);
  measure::VolumeWork other = volume();
  other.options.ert = 0;
  other.options.skip = technique::Skip::none;
  EXPECT_EQ(image({.seed = 9}, work(other, "raycast_fragment")), plain);
  EXPECT_NE(image({}, work(volume("ball"))), plain);
  other.scene.step_voxels = 1;
  EXPECT_NE(image({}, work(other)), plain);
  other = volume();
  other.scene.camera.eye.x = 1;
  EXPECT_NE(image({}, work(other)), plain);
  for (const float each : plain.rgba) EXPECT_TRUE(each >= 0 && each <= 1);
}

TEST(NullImage, InjectedFaultsShow) {
  const core::Image plain = image({}, work());
  measure::VolumeWork faulty = volume();
  faulty.options.fault = technique::Fault::half_voxel_shift;
  EXPECT_NE(image({}, work(faulty)), plain);
  const core::Image wrong =
      image(parse_script(R"({"failures": [{"kind": "wrong_image"}]})"), work());
  EXPECT_NEAR(wrong.rgba[5] - plain.rgba[5], 0.25, 1e-6);
  const core::Image nan = image(parse_script(R"({"failures": [{"kind": "nan_image"}]})"), work());
  EXPECT_TRUE(std::isnan(nan.rgba[5]));
}

TEST(NullImage, CanBeReplayed) {
  core::Image given(16, 8);
  given.rgba[7] = 0.625F;
  EXPECT_EQ(image({.draw = [&](const measure::Work&) { return given; }}, work()), given);

  const auto file = std::filesystem::path(::testing::TempDir()) / "null_backend_replay.exr";
  core::write_exr(given, file);
  const Script script{.images = {{"*data=cube,*", file.string()}}};
  EXPECT_EQ(image(script, work()), given);
  EXPECT_EQ(image(script, work(volume("ball"))), image({}, work(volume("ball"))));
  std::filesystem::remove(file);
}

TEST(NullImage, BeforeAnyFrameThereIsNone) {
  const auto opened = device({});
  EXPECT_THROW(static_cast<void>(opened->prepare(work())->image()), core::Error);
}

TEST(NullKernel, HashFollowsTheBuild) {
  const auto opened = device({});
  measure::VolumeWork other = volume();
  const std::string plain = opened->prepare(work(other))->kernel_hash();
  other.scene.step_voxels = 2;
  EXPECT_EQ(opened->prepare(work(other))->kernel_hash(), plain);
  other.options.skip = technique::Skip::none;
  EXPECT_NE(opened->prepare(work(other))->kernel_hash(), plain);
}

// Failures

Script failing(FailureKind kind, Place at, std::optional<int> frame = {},
               const std::string& only = "*") {
  return {.failures = {{.kind = kind, .at = at, .frame = frame, .only = only}}};
}

TEST(NullFailure, OccursAtItsPlaceAndFrame) {
  EXPECT_THROW(static_cast<void>(device(failing(FailureKind::api_error, Place::open))),
               core::ApiError);
  EXPECT_THROW(
      static_cast<void>(device(failing(FailureKind::device_lost, Place::prepare))->prepare(work())),
      core::DeviceLost);
  const auto opened = device(failing(FailureKind::device_lost, Place::frame, 2));
  const auto prepared = opened->prepare(work());
  EXPECT_NO_THROW(static_cast<void>(prepared->frame(Purpose::timing)));
  EXPECT_NO_THROW(static_cast<void>(prepared->frame(Purpose::timing)));
  EXPECT_THROW(static_cast<void>(prepared->frame(Purpose::timing)), core::DeviceLost);
  const auto at_image = device(failing(FailureKind::api_error, Place::image))->prepare(work());
  static_cast<void>(at_image->frame(Purpose::timing));
  EXPECT_THROW(static_cast<void>(at_image->image()), core::ApiError);
}

TEST(NullFailure, AffectsOnlyMatchingWork) {
  const auto opened =
      device(failing(FailureKind::not_supported, Place::supports, {}, "*,data=ball,*"));
  EXPECT_FALSE(opened->unsupported(work()));
  EXPECT_TRUE(opened->unsupported(work(volume("ball"))));
  EXPECT_NO_THROW(static_cast<void>(opened->prepare(work())));
  EXPECT_THROW(static_cast<void>(opened->prepare(work(volume("ball")))), core::NotSupported);
  EXPECT_TRUE(opened->unsupported(work(volume(), "telepathy")));
}

TEST(NullFailureDeathTest, EndsTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto frame = [](FailureKind kind) {
    const auto opened = device(failing(kind, Place::frame));
    static_cast<void>(opened->prepare(work())->frame(Purpose::timing));
  };
  EXPECT_EXIT(frame(FailureKind::crash), ::testing::KilledBySignal(SIGABRT), "");
  EXPECT_EXIT(frame(FailureKind::exit), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(
      {
        alarm(1);
        frame(FailureKind::hang);
      },
      ::testing::KilledBySignal(SIGALRM), "");
}

// The call log

TEST(NullLog, ContainsTheCallsInOrder) {
  const Script script{.log = std::make_shared<CallLog>()};
  {
    const auto prepared = device(script)->prepare(work());
    static_cast<void>(prepared->frame(Purpose::timing));
    static_cast<void>(prepared->image());
    static_cast<void>(prepared->frame(Purpose::statistics));
    static_cast<void>(prepared->frame(Purpose::counters));
  }
  EXPECT_THAT(*script.log, ElementsAre("open null:scripted", "prepare raycast", "frame timing",
                                       "image", "frame statistics", "frame counters", "destroy"));
}

}  // namespace
}  // namespace triptych::null_backend
