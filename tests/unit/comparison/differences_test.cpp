#include "comparison/differences.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace triptych::comparison {
namespace {

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
  // Returns the only difference. The test fails unless there is exactly one.
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
  EXPECT_TRUE(find().no_time.empty());
}

TEST_F(Differences, AcrossDriversCountsMayDifferByRounding) {
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
  EXPECT_EQ(only().cause, DifferenceCause::same_driver);
  EXPECT_EQ(only().about(), "counter samples");
  EXPECT_EQ(only().changes.at(0).before, 1000000);
  EXPECT_EQ(only().changes.at(0).now, 1000001);
}

TEST_F(Differences, RoundingMayDecideAFewSamplesOnAnotherDriver) {
  use_another_driver();
  record_b.counters["samples"] += 1;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  record_b.counters["samples"] += 1000;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
}

TEST_F(Differences, ALostCounterIsARegressionOnlyOnTheSameDriver) {
  record_b.counters.erase("rays_hit");
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  use_another_driver();
  EXPECT_EQ(only().kind, DifferenceKind::changed);
}

TEST_F(Differences, AStatisticIsComparedAsExactlyAsItsDriversCount) {
  record_b.statistics["fragment_invocations"] = 160;
  // Both numbers come from the same driver, so they must be equal.
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  use_another_driver();
  // Both drivers count exactly, but the API does not define how many fragment invocations there
  // are. A different number is therefore not a regression.
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  device_a.statistics_calibration["fragment_invocations"] = {
      .worth = record::Worth::inflated, .low = 1.02, .high = 3.9};
  EXPECT_EQ(only().kind, DifferenceKind::calibration);
  EXPECT_EQ(only().cause, DifferenceCause::counted_differently);
  EXPECT_EQ(only().worths[0]->high, 3.9);
  EXPECT_EQ(only().worths[1]->worth, record::Worth::exact);
}

TEST_F(Differences, AStatisticThatTheApisDefineMustAgree) {
  use_another_driver();
  record_b.statistics["compute_invocations"] = 65;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
}

TEST_F(Differences, AStatisticThatOnlyOneDriverReportsIsExpected) {
  use_another_driver();
  record_b.statistics["vertex_invocations"] = 6;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  EXPECT_EQ(only().cause, DifferenceCause::reported_by_one_side);
  EXPECT_EQ(only().side, measure::Side::b);
  EXPECT_EQ(only().changes.at(0).now, 6);
  EXPECT_FALSE(only().changes.at(0).before);
}

TEST_F(Differences, AnUnsteadyStatisticIsReportedEvenOnOneDriver) {
  device_a.statistics_calibration["fragment_invocations"] = {.worth = record::Worth::unsteady};
  record_b.statistics["fragment_invocations"] = 101;
  EXPECT_EQ(only().kind, DifferenceKind::calibration);
}

TEST_F(Differences, OtherBitsWithinTheBoundAreAllowedOnlyForOtherCode) {
  record_b.image = "other";
  image_b.rgba[4 * 5] += 0.005F;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_EQ(only(false).kind, DifferenceKind::changed);
  EXPECT_EQ(only().cause, DifferenceCause::other_bits_of_one_code);
  EXPECT_EQ(only(false).cause, DifferenceCause::other_bits);
  const auto numbers = only(false).numbers;
  EXPECT_EQ(numbers.at("pixels"), 1);
  EXPECT_EQ(numbers.at("total"), 16);
  EXPECT_EQ(numbers.at("x"), 1);
  EXPECT_EQ(numbers.at("y"), 1);
  EXPECT_TRUE(find(false).no_time.empty());
}

TEST_F(Differences, AWrongImageIsARegressionAndVoidsTheTime) {
  record_b.image = "other";
  image_b.rgba[4 * 5] += 0.1F;
  EXPECT_EQ(only(false).kind, DifferenceKind::regression);
  EXPECT_EQ(find().no_time.cause, TimeCause::wrong_image);
  EXPECT_EQ(find().no_time.side, measure::Side::b);
  std::swap(image_a, image_b);
  std::swap(record_a.image, record_b.image);
  EXPECT_EQ(only(false).kind, DifferenceKind::fixed);
  EXPECT_EQ(find().no_time.cause, TimeCause::wrong_image);
  EXPECT_EQ(find().no_time.side, measure::Side::a);
  image_b = image_a;
  EXPECT_EQ(only(false).kind, DifferenceKind::unjudged);
  EXPECT_TRUE(only(false).sides[0] && only(false).sides[1]);
}

TEST_F(Differences, WithoutAReferenceImageNothingPasses) {
  const Comparison found =
      find_differences({record_a, device_a, image_a, nullptr, "no memory"},
                       {record_b, device_b, image_b, nullptr, "no memory"}, true);
  ASSERT_EQ(found.differences.size(), 1U);
  EXPECT_EQ(found.differences[0].kind, DifferenceKind::unjudged);
  EXPECT_EQ(found.differences[0].cause, DifferenceCause::no_reference);
  EXPECT_EQ(found.differences[0].sides[1]->detail, "no memory");
}

TEST_F(Differences, OneMoreInstructionIsARegressionOnlyOnTheSameDevice) {
  count(1000000, 1000);
  record_b.cost["device_code"] += 1;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_EQ(only().changes.at(0).name, "device_code");
  EXPECT_EQ(only().changes.at(0).now, 1000001);
  record_b.cost["device_code"] -= 2;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  use_another_driver();
  EXPECT_EQ(only().kind, DifferenceKind::changed);
}

TEST_F(Differences, AnotherVersionMayNeedOnePercentMore) {
  count(1000000, 1000);
  device_b.driver_version = "2";
  record_b.cost["device_code"] += 10000;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
  record_b.cost["device_code"] += 100;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_NEAR(only().ratio.value(), 1.0101, 1e-4);
}

TEST_F(Differences, CountsFromDifferentCountersAreNotCompared) {
  count(1000000, 1000);
  record_b.counted_by = "another";
  record_b.cost["device_code"] *= 2;
  EXPECT_EQ(only().kind, DifferenceKind::unjudged);
}

TEST_F(Differences, OneMoreByteIsARegressionAndOneLessAChange) {
  record_a.memory = record_b.memory = {{"buffers", 1000}};
  record_b.memory["buffers"] += 1;
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  record_b.memory["buffers"] -= 2;
  EXPECT_EQ(only().kind, DifferenceKind::changed);
}

TEST_F(Differences, AConfigurationThatOnlyOneSideMeasuredIsOneDifference) {
  const auto ended = [](record::Outcome outcome) {
    record::Record record;
    record.outcome = outcome;
    record.reason = {.cause = record::Cause::error, .detail = "why"};
    return record;
  };
  record_b = ended(record::Outcome::crashed);
  EXPECT_EQ(only().kind, DifferenceKind::regression);
  EXPECT_EQ(find().no_time.cause, TimeCause::side_ended);
  EXPECT_EQ(find().no_time.side, measure::Side::b);
  EXPECT_EQ(find().no_time.outcome, record::Outcome::crashed);
  EXPECT_EQ(only().sides[1]->outcome, record::Outcome::crashed);
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
                              // not measured on device a
                              {"compute_invocations", {}}};
  const auto found = find_differences(a, b);
  ASSERT_EQ(found.size(), 4U);
  using Facts = std::map<std::string, std::string>;
  EXPECT_EQ(found[0].facts, (Facts{{"a", "1"}, {"b", "2"}}));
  EXPECT_EQ(found[1].facts, (Facts{{"a", "1"}}));
  EXPECT_EQ(found[2].facts, (Facts{{"b", "1"}}));
  EXPECT_EQ(found[3].kind, DifferenceKind::calibration);
  b.id = "gl:llvmpipe-egl";
  EXPECT_THAT(find_differences(a, b), IsEmpty());
}

// OpenCL sorts spheres into bins before drawing, whereas Vulkan and OpenGL draw them directly.
TEST_F(Differences, ACounterThatIsSpecificToAnApiIsNotComparedAcrossApis) {
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
  EXPECT_EQ(found.differences[0].about(), "statistic compute_invocations");
}

// Differences of code statistics have no ratio, but the group must begin with the worst one.
TEST(DifferenceGroups, BeginWithTheLargestChangeForTheWorse) {
  const auto code = [](double before, double now) {
    Difference difference{.kind = DifferenceKind::regression,
                          .subject = Subject::code,
                          .cause = DifferenceCause::code_changed};
    difference.code = judge::CodeComparison{};
    difference.code->changes = {
        {"x", "Inverse Throughput", judge::code_statistic("Inverse Throughput"), before, now},
        {"x", "Instructions", judge::code_statistic("Instructions"), 1000, 1}};
    return difference;
  };
  const auto groups = grouped(
      {{"first", code(1000, 1006)}, {"worst", code(1000, 1270)}, {"second", code(1000, 1100)}});
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].where, "worst");
  EXPECT_EQ(groups[0].count, 3);
  EXPECT_NEAR(groups[0].difference.size(), std::log(1.27), 1e-12);
  std::vector<std::string> order;
  for (const LocatedDifference& each : groups[0].members) order.push_back(each.first);
  EXPECT_THAT(order, testing::ElementsAre("worst", "second", "first"));
  // A statistic that was 0 before, such as spilled registers, is the worst of all.
  EXPECT_EQ(grouped({{"more", code(1000, 9000)}, {"new", code(0, 1)}}).at(0).where, "new");
}

}  // namespace
}  // namespace triptych::comparison
