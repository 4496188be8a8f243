#include "judge/compare/differences.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace triptych::judge {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Differences : public testing::Test {
 protected:
  Differences() {
    for (record::Device* device : {&device_a, &device_b}) {
      device->id = "vulkan:lavapipe";
      device->driver_version = "1";
      device->statistics_dialect = {{"fragment_invocations", "exact"},
                                    {"vertex_invocations", "exact"},
                                    {"compute_invocations", "exact"}};
    }
    for (record::Record* record : {&record_a, &record_b}) {
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

  [[nodiscard]] Comparison find(bool same_setup = true) const {
    return find_differences({record_a, device_a, image_a, &truth},
                            {record_b, device_b, image_b, &truth}, same_setup);
  }
  // The one difference there must be.
  [[nodiscard]] Difference only(bool same_setup = true) const {
    const Comparison found = find(same_setup);
    EXPECT_EQ(found.differences.size(), 1U);
    return found.differences.empty() ? Difference{} : found.differences.front();
  }

  record::Device device_a, device_b;
  record::Record record_a, record_b;
  core::Image image_a{4, 4}, image_b{4, 4};
  TruthPair truth{core::Image(4, 4), core::Image(4, 4)};
};

TEST_F(Differences, EqualRecordsHaveNone) {
  EXPECT_THAT(find().differences, IsEmpty());
  EXPECT_THAT(find().void_time, IsEmpty());
}

TEST_F(Differences, ACounterThatChangesByOneIsARegressionOnTheSameDriver) {
  record_b.counters["samples"] += 1;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_THAT(only().text, HasSubstr("1000000 → 1000001"));
}

TEST_F(Differences, RoundingMayDecideAFewSamplesOnAnotherDriver) {
  use_another_driver();
  record_b.counters["samples"] += 1;
  EXPECT_EQ(only().kind, DifferenceKind::expected);
  record_b.counters["samples"] += 1000;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
}

TEST_F(Differences, ACounterThatIsLostIsARegressionOnTheSameDriverAlone) {
  record_b.counters.erase("rays_hit");
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  use_another_driver();
  EXPECT_EQ(only().kind, DifferenceKind::expected);
}

TEST_F(Differences, AStatisticIsHeldToWhatItsDriversCanCount) {
  record_b.statistics["fragment_invocations"] = 160;
  EXPECT_EQ(only().kind, DifferenceKind::regression);  // one driver, two numbers
  use_another_driver();
  EXPECT_EQ(only().kind, DifferenceKind::expected);  // both exact, but the API leaves it open
  device_a.statistics_dialect["fragment_invocations"] = "inflated: 1.02 to 3.9";
  EXPECT_EQ(only().kind, DifferenceKind::dialect);
  EXPECT_THAT(only().text, HasSubstr("a: inflated: 1.02 to 3.9; b: exact"));
}

TEST_F(Differences, WhatDriversMustAgreeOnIsARegression) {
  use_another_driver();
  record_b.statistics["compute_invocations"] = 65;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
}

TEST_F(Differences, AStatisticThatOnlyOneDriverTellsIsExpected) {
  use_another_driver();
  record_b.statistics["vertex_invocations"] = 6;
  EXPECT_EQ(only().kind, DifferenceKind::expected);
  EXPECT_THAT(only().text, HasSubstr("only b tells it: 6"));
}

TEST_F(Differences, AnUnsteadyStatisticIsADialectEvenOnOneDriver) {
  device_a.statistics_dialect["fragment_invocations"] = "unsteady";
  record_b.statistics["fragment_invocations"] = 101;
  EXPECT_EQ(only().kind, DifferenceKind::dialect);
}

TEST_F(Differences, OtherBitsWithinTheBoundAreExpectedOfOtherCodeOnly) {
  record_b.image = "other";
  image_b.rgba[4 * 5] += 0.005F;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_EQ(only(false).kind, DifferenceKind::expected);
  EXPECT_THAT(only(false).text, HasSubstr("1 of 16 pixels differ, most at (1, 1)"));
  EXPECT_THAT(find(false).void_time, IsEmpty());
}

TEST_F(Differences, AWrongPictureIsARegressionAndVoidsTheTime) {
  record_b.image = "other";
  image_b.rgba[4 * 5] += 0.1F;
  EXPECT_EQ(only(false).kind, DifferenceKind::regression);
  EXPECT_THAT(find().void_time, HasSubstr("the picture of b is wrong"));
  std::swap(image_a, image_b);
  std::swap(record_a.image, record_b.image);
  EXPECT_EQ(only(false).kind, DifferenceKind::unjudged);
  EXPECT_THAT(find().void_time, HasSubstr("the picture of a is wrong"));
}

TEST_F(Differences, WithoutATruthNothingIsAPass) {
  const Comparison found =
      find_differences({record_a, device_a, image_a, nullptr, "no memory"},
                       {record_b, device_b, image_b, nullptr, "no memory"}, true);
  ASSERT_EQ(found.differences.size(), 1U);
  EXPECT_EQ(found.differences[0].kind, DifferenceKind::unjudged);
  EXPECT_THAT(found.differences[0].text, HasSubstr("no memory"));
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
}  // namespace triptych::judge
