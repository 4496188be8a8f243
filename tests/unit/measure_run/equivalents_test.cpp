// Tests which configurations are recognized as doing the same work, and how runs reuse their
// results.

#include "measure/contract/equivalents.hpp"

#include <limits>

#include "tests/unit/measure_run/run_fixture.hpp"

namespace triptych::measure {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

Work volume_over(float background) {
  VolumeWork volume;
  volume.scene.background = {0, 0, 0, background};
  return {.technique = "raycast", .scene = volume};
}

core::Image make_image(const std::vector<float>& alphas) {
  core::Image image;
  image.width = static_cast<int>(alphas.size());
  image.height = 1;
  for (const float alpha : alphas) image.rgba.insert(image.rgba.end(), {0, 0, 0, alpha});
  return image;
}

TEST(LeastTransmittance, FollowsFromTheVisibleBackground) {
  EXPECT_NEAR(least_transmittance(volume_over(0), make_image({0.25F, 0.75F, 0.5F})), 0.25, 1e-6);
  // The background has the opacity 0.25. If T is the transmittance of the volume in front of it,
  // the pixel has the opacity 1 − T + T·0.25. For the opacity 0.85, T is 0.2.
  EXPECT_NEAR(least_transmittance(volume_over(0.25F), make_image({0.25F, 0.85F})), 0.2, 1e-6);
}

TEST(LeastTransmittance, IsZeroIfItCannotBeDetermined) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(least_transmittance(volume_over(1), make_image({0.5F})), 0);
  EXPECT_EQ(least_transmittance(volume_over(0), make_image({1.0F})), 0);
  EXPECT_EQ(least_transmittance(volume_over(0), make_image({0.5F, nan, 0.1F})), 0);
  EXPECT_EQ(least_transmittance(volume_over(0), make_image({})), 0);
  EXPECT_EQ(
      least_transmittance({.technique = "tiles", .scene = ParticleWork{}}, make_image({0.5F})), 0);
}

class EquivalentsOf : public testing::Test {
 protected:
  static PlainWork plain(const std::string& step, double ends_below) {
    return {.levels = {{"step", step}}, .ends_below = ends_below};
  }
  EquivalentsOf() { equivalents.add(plain("1", 0), "first", volume_over(0), make_image({0.75F})); }
  Equivalents equivalents;
};

TEST_F(EquivalentsOf, EarlyTerminationThatNoRayReachesIsEquivalent) {
  const auto equivalent = equivalents.find(plain("1", 0.125));
  ASSERT_TRUE(equivalent);
  EXPECT_EQ(equivalent->key, "first");
  EXPECT_EQ(equivalent->reason, "ert: no ray's transmittance falls below 0.25");
  EXPECT_FALSE(equivalents.find(plain("1", 0.3)));
  EXPECT_FALSE(equivalents.find(plain("2", 0.125)));
}

TEST_F(EquivalentsOf, TerminatedRaysProveNothingAboutLowerThresholds) {
  equivalents.add(plain("2", 0.3), "second", volume_over(0), make_image({0.75F}));
  EXPECT_FALSE(equivalents.find(plain("2", 0)));
  EXPECT_TRUE(equivalents.find(plain("2", 0.3)));
}

TEST_F(EquivalentsOf, TheReasonNamesTheReplacedLevel) {
  PlainWork replaced_skip = plain("1", 0);
  replaced_skip.why["skip"] = "nothing is empty";
  const auto equivalent = equivalents.find(replaced_skip);
  ASSERT_TRUE(equivalent);
  EXPECT_EQ(equivalent->reason, "skip: nothing is empty");
}

// With the fake suite's data `full`, skip=bricks and skip=none do the same work.
class RunEquivalents : public RunTest {
 protected:
  Plan full(const std::string& data = "full",
            const std::vector<std::string>& skip = {"none", "bricks"}) {
    return plan({{"technique", {"raycast"}},
                 {"data", {data}},
                 {"step", {"1"}},
                 {"camera", {"random:7"}},
                 {"skip", skip}});
  }
  // Returns the records by configuration key. Keys omit default levels, such as skip=bricks.
  [[nodiscard]] std::map<std::string, record::Record> by_key(const RunResult& result) const {
    std::map<std::string, record::Record> all;
    for (const record::Record& record : records(result.run)) all[record.configuration] = record;
    return all;
  }
  const std::string bricks = "camera=random:7,data=full,technique=raycast,viewport=8";
  const std::string none = "camera=random:7,data=full,skip=none,technique=raycast,viewport=8";
};

TEST_F(RunEquivalents, CopyTheFramesOfTheFirst) {
  const RunResult result = run(full());
  EXPECT_EQ(result.measured, 2);
  EXPECT_EQ(result.copied, 1);
  auto all = by_key(result);
  ASSERT_TRUE(all.contains(none) && all.contains(bricks));
  const record::Record& first = all[none];
  const record::Record& other = all[bricks];
  EXPECT_EQ(first.same_as, "");
  EXPECT_EQ(other.same_as, none);
  EXPECT_EQ(other.reason.cause, record::Cause::same_frames);
  EXPECT_EQ(other.reason.detail, "skip: nothing is empty");
  EXPECT_EQ(other.wall_ns, first.wall_ns);
  EXPECT_EQ(other.counters, first.counters);
  EXPECT_EQ(other.image, first.image);
  EXPECT_EQ(other.factors.at("skip"), "bricks");
  EXPECT_THAT(other.wall_ns, SizeIs(8));
  EXPECT_TRUE(other.benchmark_json.empty());
}

TEST_F(RunEquivalents, AreMeasuredIfTheyDifferInTheScene) {
  EXPECT_EQ(run(full("cube")).copied, 0);
}

TEST_F(RunEquivalents, AreMeasuredOnRequest) {
  options.protocol.measure_every = true;
  EXPECT_EQ(run(full()).copied, 0);
}

TEST_F(RunEquivalents, AreMeasuredIfAFaultIsInjected) {
  options.faults = {{.fault = "half_voxel_shift", .only = {}}};
  EXPECT_EQ(run(full()).copied, 0);
}

// Untimed runs also reuse the results of equal work: the records contain the same frames.
TEST_F(RunEquivalents, ShareImagesOfAnUntimedRun) {
  options.protocol.timed = false;
  const RunResult result = run(full());
  EXPECT_EQ(result.copied, 1);
  auto all = by_key(result);
  EXPECT_EQ(all[bricks].same_as, none);
  EXPECT_EQ(all[bricks].image, all[none].image);
  EXPECT_EQ(all[bricks].counters, all[none].counters);
  EXPECT_TRUE(all[none].untimed() && all[bricks].untimed());
}

TEST_F(RunEquivalents, AreDrawnByAPlanForImagesOnly) {
  Plan what = full();
  what.checks = {record::Check::image, record::Check::counters};
  EXPECT_EQ(run(what).copied, 0);
}

}  // namespace
}  // namespace triptych::measure
