#include "comparison/differences.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace triptych::comparison {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Differences : public testing::Test {
 protected:
  Differences() {
    for (record::Device* device : {&device_a, &device_b}) {
      device->id = "vulkan:lavapipe";
      device->driver_version = "1";
      device->statistics_calibration = {
          {"fragment_invocations", {}}, {"vertex_invocations", {}}, {"compute_invocations", {}}};
    }
    for (record::Record* record : {&record_a, &record_b}) {
      record->outcome = record::Outcome::measured;
      record->device = "vulkan:lavapipe";
      record->technique = "raycast";
      record->image = "same";
      record->kernel_hash = "code";
      record->counters = {{"samples", 1000000}, {"rays_hit", 64}};
      record->statistics = {{"fragment_invocations", 100}, {"compute_invocations", 64}};
    }
    image_a.rgba.assign(image_a.rgba.size(), 0.5F);
    image_b = truth.truth = image_a;
    truth.bound.rgba.assign(truth.bound.rgba.size(), 0.01F);
  }

  void use_another_driver() {
    device_b.id = "gl:llvmpipe-egl";
    device_b.driver_version = "2";
  }

  void count(std::uint64_t device_code, std::uint64_t driver) {
    for (record::Record* record : {&record_a, &record_b}) {
      record->counted_by = "valgrind";
      record->cost = {{"device_code", device_code}, {"driver", driver}};
    }
  }

  [[nodiscard]] Comparison find(bool same_setup = true) const {
    return find_differences({record_a, device_a, image_a, &truth, {}, open_counts},
                            {record_b, device_b, image_b, &truth, {}, open_counts}, same_setup);
  }
  // The only difference; there must be exactly one.
  [[nodiscard]] Difference only(bool same_setup = true) const {
    const Comparison found = find(same_setup);
    EXPECT_EQ(found.differences.size(), 1U);
    return found.differences.empty() ? Difference{} : found.differences.front();
  }

  record::Device device_a, device_b;
  record::Record record_a, record_b;
  core::Image image_a{4, 4}, image_b{4, 4};
  judge::TruthPair truth{core::Image(4, 4), core::Image(4, 4)};
  judge::FindOpenCounts open_counts;
};

TEST_F(Differences, EqualRecordsHaveNone) {
  EXPECT_THAT(find().differences, IsEmpty());
  EXPECT_THAT(find().void_time, IsEmpty());
}

TEST_F(Differences, AcrossDriversAsManyCountsAreOpenAsRoundingDecides) {
  use_another_driver();
  open_counts = [](const record::Record&) {
    return std::map<std::string, double>{{"samples", 1000}};
  };
  record_b.counters["samples"] = 999000;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  record_b.counters["samples"] = 998999;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
}

TEST_F(Differences, ACounterThatChangesByOneIsARegressionOnTheSameDriver) {
  record_b.counters["samples"] += 1;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_THAT(only().text, HasSubstr("1000000 → 1000001"));
}

TEST_F(Differences, RoundingMayDecideAFewSamplesOnAnotherDriver) {
  use_another_driver();
  record_b.counters["samples"] += 1;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  record_b.counters["samples"] += 1000;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
}

TEST_F(Differences, ACounterThatIsLostIsARegressionOnTheSameDriverAlone) {
  record_b.counters.erase("rays_hit");
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  use_another_driver();
  EXPECT_EQ(only().kind, DifferenceKind::changed);
}

TEST_F(Differences, AStatisticIsHeldToWhatItsDriversCanCount) {
  record_b.statistics["fragment_invocations"] = 160;
  EXPECT_EQ(only().kind, DifferenceKind::regression);  // one driver with two numbers
  use_another_driver();
  EXPECT_EQ(only().kind, DifferenceKind::changed);  // open, though both are exact
  device_a.statistics_calibration["fragment_invocations"] = {
      .worth = record::Worth::inflated, .low = 1.02, .high = 3.9};
  EXPECT_EQ(only().kind, DifferenceKind::calibration);
  EXPECT_THAT(only().text, HasSubstr("a: 1.02 to 3.9 times the true number; b: exact"));
}

TEST_F(Differences, WhatDriversMustAgreeOnIsARegression) {
  use_another_driver();
  record_b.statistics["compute_invocations"] = 65;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
}

TEST_F(Differences, AStatisticThatOnlyOneDriverTellsIsExpected) {
  use_another_driver();
  record_b.statistics["vertex_invocations"] = 6;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  EXPECT_THAT(only().text, HasSubstr("only b tells it: 6"));
}

TEST_F(Differences, AnUnsteadyStatisticIsReportedEvenOnOneDriver) {
  device_a.statistics_calibration["fragment_invocations"] = {.worth = record::Worth::unsteady};
  record_b.statistics["fragment_invocations"] = 101;
  EXPECT_EQ(only().kind, DifferenceKind::calibration);
}

TEST_F(Differences, OtherBitsWithinTheBoundAreExpectedOfOtherCodeOnly) {
  record_b.image = "other";
  image_b.rgba[4 * 5] += 0.005F;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_EQ(only(false).kind, DifferenceKind::changed);
  EXPECT_THAT(only(false).text, HasSubstr("1 of 16 pixels differ, most at (1, 1)"));
  EXPECT_THAT(find(false).void_time, IsEmpty());
}

TEST_F(Differences, AWrongPictureIsARegressionAndVoidsTheTime) {
  record_b.image = "other";
  image_b.rgba[4 * 5] += 0.1F;
  EXPECT_EQ(only(false).kind, DifferenceKind::regression);
  EXPECT_THAT(find().void_time, HasSubstr("the image of b is wrong"));
  std::swap(image_a, image_b);
  std::swap(record_a.image, record_b.image);
  EXPECT_EQ(only(false).kind, DifferenceKind::fixed);
  EXPECT_THAT(find().void_time, HasSubstr("the image of a is wrong"));
  image_b = image_a;
  EXPECT_EQ(only(false).kind, DifferenceKind::unjudged);
  EXPECT_THAT(only(false).text, HasSubstr("both are wrong"));
}

TEST_F(Differences, WithoutATruthNothingIsAPass) {
  const Comparison found =
      find_differences({record_a, device_a, image_a, nullptr, "no memory"},
                       {record_b, device_b, image_b, nullptr, "no memory"}, true);
  ASSERT_EQ(found.differences.size(), 1U);
  EXPECT_EQ(found.differences[0].kind, DifferenceKind::unjudged);
  EXPECT_THAT(found.differences[0].text, HasSubstr("no memory"));
}

TEST_F(Differences, OneInstructionMoreIsARegressionOfTheSameDeviceAlone) {
  count(1000000, 1000);
  record_b.cost["device_code"] += 1;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_THAT(only().text, HasSubstr("generated code 1000000 → 1000001"));
  record_b.cost["device_code"] -= 2;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  use_another_driver();
  EXPECT_EQ(only().kind, DifferenceKind::changed);
}

TEST_F(Differences, AnotherVersionMayTakeOnePercentMore) {
  count(1000000, 1000);
  device_b.driver_version = "2";
  record_b.cost["device_code"] += 10000;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  record_b.cost["device_code"] += 100;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_NEAR(only().ratio.value(), 1.0101, 1e-4);
}

TEST_F(Differences, CountsOfTwoCountersAreNotCompared) {
  count(1000000, 1000);
  record_b.counted_by = "another";
  record_b.cost["device_code"] *= 2;
  EXPECT_EQ(only().kind, DifferenceKind::unjudged);
}

TEST_F(Differences, OneByteMoreIsARegressionAndOneLessAChange) {
  record_a.memory = record_b.memory = {{"buffers", 1000}};
  record_b.memory["buffers"] += 1;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  record_b.memory["buffers"] -= 2;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
}

TEST_F(Differences, WhatOnlyOneSideCouldDoIsOneDifference) {
  const auto ended = [](record::Outcome outcome) {
    record::Record record;
    record.outcome = outcome;
    record.reason = {.cause = record::Cause::error, .detail = "why"};
    return record;
  };
  record_b = ended(record::Outcome::crashed);
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_THAT(find().void_time, HasSubstr("b crashed: why"));
  record_b = ended(record::Outcome::skipped);
  EXPECT_EQ(only().kind, DifferenceKind::unjudged);
  std::swap(record_a, record_b);
  EXPECT_EQ(only().kind, DifferenceKind::fixed);
  record_b = record_a;
  EXPECT_THAT(find().differences, IsEmpty());
}

TEST(DeviceDifferences, LimitsAreGainedLostAndChanged) {
  record::Device a;
  a.id = "vulkan:lavapipe";
  record::Device b = a;
  a.limits = {{"x", "1"}, {"y", "1"}};
  b.limits = {{"x", "2"}, {"z", "1"}};
  a.statistics_calibration = {{"fragment_invocations", {.worth = record::Worth::inflated}}};
  b.statistics_calibration = {{"fragment_invocations", {}},
                              {"compute_invocations", {}}};  // the run of a drew none of these
  const auto found = find_differences(a, b);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].text, "1 → 2");
  EXPECT_EQ(found[1].text, "gone, was 1");
  EXPECT_EQ(found[2].text, "new: 1");
  EXPECT_EQ(found[3].kind, DifferenceKind::calibration);
  b.id = "gl:llvmpipe-egl";
  EXPECT_THAT(find_differences(a, b), IsEmpty());
}

// OpenCL sorts spheres into bins, and Vulkan and GL draw them at once.
TEST_F(Differences, WhatAnApiCountsInItsOwnWayIsNoRegressionOfAnother) {
  use_another_driver();
  record_a.counters["bin_entries"] = 44;
  record_b.counters["bin_entries"] = 13237;
  EXPECT_EQ(find().differences.at(0).kind, DifferenceKind::regression);
  device_b.api = "opencl";
  EXPECT_EQ(find().differences.at(0).kind, DifferenceKind::changed);
}

TEST_F(Differences, TheWorstComesFirst) {
  use_another_driver();
  record_b.statistics["fragment_invocations"] = 160;
  record_b.statistics["compute_invocations"] = 65;
  const Comparison found = find();
  ASSERT_EQ(found.differences.size(), 2U);
  EXPECT_EQ(found.differences[0].about, "statistic compute_invocations");
}

}  // namespace
}  // namespace triptych::comparison
