// Records that fail, and those that do not.

#include "reduction/failure.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace triptych::reduction {
namespace {

using ::testing::HasSubstr;

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
    evidence.picture = [this](const record::Record&) { return grey(2, value); };
  }

  record::Record record;
  record::Record other;
  float value = 0.5F;
  Evidence evidence;
};

TEST_F(FailureOf, ARightPictureIsNone) {
  EXPECT_FALSE(failure_of(record, evidence));
}

TEST_F(FailureOf, APictureBeyondItsBoundIsOfOneKindWhateverItsNumbers) {
  value = 0.6F;
  const auto some = failure_of(record, evidence);
  ASSERT_TRUE(some);
  EXPECT_THAT(some->message, HasSubstr("4 of 4 pixels are over the bound against the truth"));
  value = 0.9F;
  EXPECT_EQ(failure_of(record, evidence)->kind, some->kind);
  value = NAN;
  EXPECT_NE(failure_of(record, evidence)->kind, some->kind);
}

TEST_F(FailureOf, ACrashAndAHangAreOfTheirOwnKinds) {
  record.outcome = record::Outcome::crashed;
  record.reason = "killed by SIGSEGV";
  const auto crash = failure_of(record, evidence);
  ASSERT_TRUE(crash);
  EXPECT_EQ(crash->message, "crashed: killed by SIGSEGV");
  record.outcome = record::Outcome::hung;
  EXPECT_NE(failure_of(record, evidence)->kind, crash->kind);
}

TEST_F(FailureOf, ASkipIsNone) {
  record.outcome = record::Outcome::skipped;
  EXPECT_FALSE(failure_of(record, evidence));
}

TEST_F(FailureOf, CountersAreHeldAgainstAnotherDeviceOnly) {
  other.counters = {{"samples", 200}};
  EXPECT_FALSE(failure_of(record, evidence));
  evidence.other = [this](const record::Record&) { return other; };
  const auto changed = failure_of(record, evidence);
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->kind, other_counters);
  EXPECT_THAT(changed->message, HasSubstr("samples 100"));
  other.counters = record.counters;
  EXPECT_FALSE(failure_of(record, evidence));
}

TEST_F(FailureOf, CountersOfADeviceThatCouldNotDrawItAreNoMeasure) {
  other.counters = {{"samples", 200}};
  other.outcome = record::Outcome::crashed;
  evidence.other = [this](const record::Record&) { return other; };
  EXPECT_FALSE(failure_of(record, evidence));
}

}  // namespace
}  // namespace triptych::reduction
