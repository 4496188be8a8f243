#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "analysis/observations.hpp"

namespace triptych::analysis {
namespace {

using testing::Contains;
using testing::HasSubstr;

Source source(const std::string& device, const std::string& camera, double ms,
              const std::string& run = "r1") {
  Source result{.file = "s.sqlite", .run = {run, "volume/study", "2026-01-0" + run.substr(1), {}}};
  result.device.id = device;
  result.record.run = run;
  result.record.suite = "volume";
  result.record.device = device;
  result.record.technique = "raycast";
  result.record.configuration = "camera=" + camera + ",data=ball,technique=raycast";
  result.record.factors = {{"camera", camera}, {"data", "ball"}, {"step", "1"}};
  result.record.outcome = record::Outcome::measured;
  result.record.wall_ns = {ms * 1e6, ms * 1.1e6, ms * 2e6};
  result.record.device_ns = {ms * 0.9e6};
  result.record.device_clock_trusted = true;
  return result;
}

TEST(Observations, MedianOfTheTrustedDeviceClock) {
  const std::vector<Source> sources{source("a", "orbit_y:0/2", 10), source("b", "orbit_y:0/2", 20)};
  const Dataset dataset = join(sources, ClockChoice::automatic).at(0);
  EXPECT_EQ(dataset.clock, "device");
  ASSERT_EQ(dataset.observations.size(), 2U);
  EXPECT_NEAR(dataset.observations[0].ms, 9, 1e-12);
  EXPECT_NEAR(dataset.observations[0].wall_ms, 11, 1e-12);
  EXPECT_EQ(dataset.observations[1].factors.at("device"), "b");
}

TEST(Observations, OneRecordWithoutDeviceTimeTurnsAllToTheWallClock) {
  std::vector<Source> sources{source("a", "orbit_y:0/2", 10), source("b", "orbit_y:0/2", 20)};
  sources[1].record.device_clock_trusted = false;
  const Dataset dataset = join(sources, ClockChoice::automatic).at(0);
  EXPECT_EQ(dataset.clock, "wall");
  EXPECT_NEAR(dataset.observations[0].ms, 11, 1e-12);
  EXPECT_THAT(dataset.notes, Contains(HasSubstr("1 records of b have no trusted device time")));
  EXPECT_EQ(join(sources, ClockChoice::device).at(0).observations.size(), 1U);
}

TEST(Observations, LatestOfTwoRunsWhateverTheOrder) {
  const std::vector<Source> sources{source("a", "orbit_y:0/2", 30, "r3"),
                                    source("a", "orbit_y:0/2", 20, "r2")};
  const Dataset dataset = join(sources, ClockChoice::wall).at(0);
  ASSERT_EQ(dataset.observations.size(), 1U);
  EXPECT_NEAR(dataset.observations[0].ms, 33, 1e-12);
  ASSERT_EQ(dataset.duplicates.size(), 1U);
  EXPECT_EQ(dataset.duplicates[0].taken, "r3 in s.sqlite");
  EXPECT_EQ(dataset.duplicates[0].dropped, "r2 in s.sqlite");
}

TEST(Observations, SuitesAreKeptApart) {
  std::vector<Source> sources{source("a", "orbit_y:0/2", 10), source("a", "orbit_y:0/2", 20)};
  sources[1].record.suite = "particles";
  const auto datasets = join(sources, ClockChoice::wall);
  ASSERT_EQ(datasets.size(), 2U);
  EXPECT_EQ(datasets[0].suite, "particles");
  EXPECT_TRUE(datasets[0].duplicates.empty());
}

TEST(Observations, AnotherDriverIsAnotherDevice) {
  std::vector<Source> sources{source("a", "orbit_y:0/2", 10), source("a", "orbit_y:0/2", 20, "r2")};
  sources[1].device.driver_version = "23";
  const Dataset dataset = join(sources, ClockChoice::wall).at(0);
  EXPECT_EQ(dataset.observations.size(), 2U);
  EXPECT_TRUE(dataset.duplicates.empty());
  EXPECT_TRUE(dataset.observations[0].factors.at("device").starts_with("a@"));
  EXPECT_EQ(dataset.notes.size(), 2U);
}

TEST(Observations, WhatIsNoMeasurementIsLeftAsideAndSaid) {
  std::vector<Source> sources(4, source("a", "orbit_y:0/2", 10));
  sources[0].record.outcome = record::Outcome::skipped;
  sources[1].record.planted = "slowdown:20";
  sources[2].record.wall_ns.clear();
  const Dataset dataset = join(sources, ClockChoice::wall).at(0);
  EXPECT_EQ(dataset.observations.size(), 1U);
  EXPECT_THAT(dataset.notes, Contains(HasSubstr("1 records skipped on a")));
  EXPECT_THAT(dataset.notes, Contains(HasSubstr("planted")));
  EXPECT_THAT(dataset.notes, Contains(HasSubstr("without a time")));
}

TEST(Observations, WhatTheDeviceChoseIsNoFactor) {
  std::vector<Source> sources{source("a", "orbit_y:0/2", 10), source("b", "orbit_y:0/2", 20)};
  sources[0].record.factors["voxel"] = "u8";
  sources[1].record.factors["voxel"] = "f32";
  EXPECT_FALSE(join(sources, ClockChoice::wall).at(0).observations[0].factors.contains("voxel"));
  for (Source& each : sources) {
    each.record.configuration += ",voxel=" + each.record.factors["voxel"];
  }
  EXPECT_EQ(join(sources, ClockChoice::wall).at(0).observations[1].factors.at("voxel"), "f32");
}

TEST(Observations, NaturalOrder) {
  EXPECT_TRUE(natural_less("generate:x:32", "generate:x:128"));
  EXPECT_TRUE(natural_less("0.25", "0.5"));
  EXPECT_TRUE(natural_less("96", "192"));
  EXPECT_TRUE(natural_less("orbit_y", "path_z"));
  EXPECT_FALSE(natural_less("a1", "a1"));
  EXPECT_THROW(static_cast<void>(clock_choice("cpu")), core::InputError);
}

}  // namespace
}  // namespace triptych::analysis
