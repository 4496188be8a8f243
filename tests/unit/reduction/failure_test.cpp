// Tests which records count as failures, and which failures are of the same kind.

#include "reduction/failure.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace triptych::reduction {
namespace {

core::Image grey(int side, float value) {
  core::Image image(side, side);
  for (float& each : image.rgba) each = value;
  return image;
}

class FailureOf : public testing::Test {
 protected:
  FailureOf() {
    record.device = "vulkan:a";
    record.outcome = record::Outcome::measured;
    record.image = "hash";
    record.counters = {{"samples", 100}};
    other = record;
    other.device = "gl:b";
    evidence.truth = [](const record::Record&) {
      return judge::TruthPair{grey(2, 0.5F), grey(2, 0.01F)};
    };
    evidence.image = [this](const record::Record&) { return grey(2, value); };
  }

  record::Record record;
  record::Record other;
  float value = 0.5F;
  Evidence evidence;
};

TEST_F(FailureOf, ACorrectImageIsNotAFailure) {
  EXPECT_FALSE(failure_of(record, evidence));
}

TEST_F(FailureOf, WrongImagesAreOneKindWhateverTheirNumbers) {
  value = 0.6F;
  const auto some = failure_of(record, evidence);
  ASSERT_TRUE(some);
  EXPECT_EQ(some->cause, judge::Cause::pixels_over_bound);
  EXPECT_EQ(some->number("pixels_over"), 4);
  value = 0.9F;
  EXPECT_TRUE(is_same_kind(*failure_of(record, evidence), *some));
  value = NAN;
  EXPECT_FALSE(is_same_kind(*failure_of(record, evidence), *some));
}

TEST_F(FailureOf, CrashesAndHangsAreSeparateKinds) {
  record.outcome = record::Outcome::crashed;
  record.reason = {.cause = record::Cause::signal, .numbers = {{"signal", 11}}};
  const auto crash = failure_of(record, evidence);
  ASSERT_TRUE(crash);
  EXPECT_EQ(crash->reason, record.reason);
  record.outcome = record::Outcome::hung;
  EXPECT_FALSE(is_same_kind(*failure_of(record, evidence), *crash));
}

TEST_F(FailureOf, ASkipIsNotAFailure) {
  record.outcome = record::Outcome::skipped;
  EXPECT_FALSE(failure_of(record, evidence));
}

TEST_F(FailureOf, CountersAreComparedOnlyWithAnotherDevice) {
  other.counters = {{"samples", 200}};
  EXPECT_FALSE(failure_of(record, evidence));
  evidence.other = [this](const record::Record&) { return other; };
  const auto changed = failure_of(record, evidence);
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->cause, judge::Cause::values_changed);
  ASSERT_EQ(changed->changes.size(), 1U);
  EXPECT_EQ(changed->changes[0].name, "samples");
  EXPECT_EQ(changed->changes[0].now, 100);
  other.counters = record.counters;
  EXPECT_FALSE(failure_of(record, evidence));
}

TEST_F(FailureOf, CountersOfADeviceThatFailedAreNotUsed) {
  other.counters = {{"samples", 200}};
  other.outcome = record::Outcome::crashed;
  evidence.other = [this](const record::Record&) { return other; };
  EXPECT_FALSE(failure_of(record, evidence));
}

}  // namespace
}  // namespace triptych::reduction
