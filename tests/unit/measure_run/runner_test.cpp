#include "measure/run/runner.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "core/json.hpp"
#include "record/benchmark_entries.hpp"
#include "tests/unit/measure_run/run_fixture.hpp"

namespace triptych::measure {
namespace {

using record::Outcome;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(RunTest, MeasuresAndReportsEveryConfigurationOnEveryDevice) {
  const Variable two("TRIPTYCH_NULL_SCRIPT", R"({"base_ns": 3e6, "devices": [1, 2]})");
  const RunResult result = run(small_plan(), {"null:scripted", "null:scripted#2"});
  EXPECT_EQ(result.measured, 8);
  EXPECT_EQ(result.skipped + result.failed, 0);
  EXPECT_EQ(reported.size(), 8U);
  // Each device has one worker, which serves it for the whole run.
  EXPECT_EQ(started_workers().size(), 2U);
  EXPECT_GT(result.wall_ns, result.overhead_ns);
  std::set<std::pair<std::string, std::string>> cells;
  for (const record::Record& record : records(result.run)) {
    cells.emplace(record.device, record.configuration);
  }
  EXPECT_EQ(cells.size(), 8U);
}

TEST_F(RunTest, RecordsDescribeTheirConfigurationCompletely) {
  const Plan one = plan({{"technique", {"raycast"}},
                         {"data", {"cube"}},
                         {"step", {"0.5"}},
                         {"camera", {"random:7"}}});
  const RunResult result = run(one);
  const auto all = records(result.run);
  ASSERT_EQ(all.size(), 1U);
  const record::Record& record = all.front();
  EXPECT_EQ(record.outcome, Outcome::measured) << record.reason.detail;
  EXPECT_EQ(record.suite, "fake");
  EXPECT_EQ(record.plan, "fake/quick");
  EXPECT_EQ(record.configuration, configuration_key(suite, one.configurations.front()));
  EXPECT_EQ(record.scene, scene_key(suite, one.configurations.front()));
  EXPECT_EQ(record.technique, "raycast");
  EXPECT_EQ(record.device, "null:scripted");
  EXPECT_NE(record.factors.at("sampler"), "auto");  // the device determines the sampler
  EXPECT_EQ(record.injected, "");
  EXPECT_EQ(record.wall_ns.size(), 8U);
  EXPECT_EQ(record.device_ns.size(), 8U);
  EXPECT_EQ(record.clock(), "device");
  EXPECT_GE(record.warm_up_frames, 4);
  EXPECT_GT(record.loop_wall_ns, 0);
  EXPECT_GT(record.prepare_ns, 0);
  EXPECT_GT(record.overhead_ns, 0);
  EXPECT_GT(record.peak_memory_bytes, 1U << 20U);
  EXPECT_TRUE(record.counters.contains("samples"));
  EXPECT_TRUE(record.statistics.contains("compute_invocations"));
  EXPECT_FALSE(record.data_hash.empty() || record.kernel_hash.empty());
  EXPECT_TRUE(record.precision.contains("filter_weight_error"));
  EXPECT_THAT(
      record::unpack_benchmark_entries(record.benchmark_json).at(0).at("name").get<std::string>(),
      testing::StartsWith("null:scripted/" + record.configuration));
}

TEST_F(RunTest, ImagesAreStoredUnderTheirHash) {
  const RunResult result = run(small_plan());
  const record::Store store = open_store();
  for (const record::Record& record : store.records(result.run)) {
    const core::Image image = core::decode_exr(store.image(record.image));
    EXPECT_EQ(image_hash(image), record.image);
    EXPECT_EQ(image.width, 8);
  }
}

TEST_F(RunTest, RunsRecordSystemDevicesAndClocks) {
  const RunResult result = run(small_plan());
  const record::Store store = open_store();
  const auto latest = store.latest_run("fake/quick");
  ASSERT_TRUE(latest);
  EXPECT_EQ(latest->id, result.run);
  EXPECT_THAT(latest->started_at, testing::MatchesRegex("....-..-..T..:..:..Z"));
  for (const char* fact : {"os", "kernel", "compiler", "cores", "memory_bytes", "triptych"}) {
    EXPECT_TRUE(latest->system.contains(fact)) << fact;
  }
  const auto devices = store.devices(result.run);
  ASSERT_EQ(devices.size(), 1U);
  // The plan contains no drawing technique, so no clock for draws is calibrated.
  ASSERT_EQ(devices[0].clocks.size(), 1U);
  EXPECT_EQ(devices[0].clocks[0].work, "compute");
  EXPECT_TRUE(devices[0].clocks[0].trusted) << devices[0].clocks[0].verdict;
}

TEST_F(RunTest, AWrongClockIsDetectedAndTheWallClockIsUsed) {
  const Variable wrong_clock("TRIPTYCH_NULL_SCRIPT",
                             R"({"base_ns": 3e6, "device_over_wall": 0.1})");
  const RunResult result = run(small_plan());
  for (const record::Record& record : records(result.run)) {
    EXPECT_EQ(record.clock(), "wall");
    EXPECT_EQ(record.device_ns.size(), 8U);
  }
  EXPECT_THAT(open_store().devices(result.run)[0].clocks[0].verdict, HasSubstr("not trusted"));
}

TEST_F(RunTest, UnsupportedConfigurationsAreSkippedWithAReason) {
  const Variable partial(
      "TRIPTYCH_NULL_SCRIPT",
      R"({"base_ns": 3e6, "failures": [{"kind": "not_supported", "at": "supports", "only": "*step=0.5*"}]})");
  const RunResult result = run(small_plan());
  EXPECT_EQ(result.measured, 2);
  EXPECT_EQ(result.skipped, 2);
  for (const record::Record& record : records(result.run)) {
    if (record.outcome != Outcome::skipped) continue;
    EXPECT_EQ(record.reason.cause, record::Cause::not_supported);
    EXPECT_THAT(record.wall_ns, IsEmpty());
    EXPECT_EQ(record.image, "");
  }
}

TEST_F(RunTest, MissingDataIsSkippedWithTheReason) {
  const RunResult result =
      run(plan({{"technique", {"raycast"}}, {"data", {"absent", "cube"}}, {"step", {"1"}}}));
  EXPECT_EQ(result.measured, 2);
  EXPECT_EQ(result.skipped, 2);
  const auto all = records(result.run);
  EXPECT_EQ(std::ranges::count(all, "absent: no such file",
                               [](const auto& each) { return each.reason.detail; }),
            2);
}

TEST_F(RunTest, InjectedFaultsAffectRecordAndImage) {
  const RunResult plain = run(small_plan());
  const auto before = records(plain.run);
  options.faults = {{"flipped_axis", "*step=0.5*"}};
  const RunResult faulty = run(small_plan());
  const auto after = records(faulty.run);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    const bool hit = after[i].factors.at("step") == "0.5";
    EXPECT_EQ(after[i].injected, hit ? "flipped_axis" : "");
    EXPECT_EQ(after[i].image != before[i].image, hit);
    EXPECT_EQ(after[i].configuration, before[i].configuration);
  }
}

TEST_F(RunTest, AnInjectedSlowdownIsThatMuchMoreWork) {
  const auto before = records(run(small_plan()).run);
  options.faults = {{"slowdown:20", "null:*"}};
  const auto after = records(run(small_plan()).run);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].injected, "slowdown:20");
    EXPECT_NEAR(after[i].wall_ns[0] / before[i].wall_ns[0], 1.2, 1e-9);
  }
}

// Sides that are measured in parallel report their joint progress, so the last report counts the
// configurations of both sides. Otherwise, it counts only those of the second side.
TEST_F(RunTest, SidesRunInParallelUnlessTheyAreTimed) {
  const auto total = [this](bool timed) {
    options.protocol = brief_protocol;
    options.protocol.timed = timed;
    const Plan both = small_plan();
    record::Store store = open_store();
    int last = 0;
    const auto results =
        run_sides({both, suite, {"null:scripted", "null:scripted"}, {options, options}}, store,
                  [&last](const Progress& progress) {
                    if (!progress.loading) last = std::max(last, progress.total);
                  });
    EXPECT_EQ(results[0].measured + results[1].measured, 8);
    return last;
  };
  EXPECT_EQ(total(true), 4);
  EXPECT_EQ(total(false), 8);
}

TEST_F(RunTest, UnknownFaultsAndLpPerfAreRejectedBeforeMeasuring) {
  options.faults = {{"gremlin", ""}};
  EXPECT_THROW(run(small_plan()), core::InputError);
  options.faults.clear();
  const Variable set("LP_PERF", "no_depth");
  EXPECT_THROW(run(small_plan()), core::InputError);
  EXPECT_THAT(started_workers(), IsEmpty());
  EXPECT_THAT(open_store().runs(), IsEmpty());
}

}  // namespace
}  // namespace triptych::measure
