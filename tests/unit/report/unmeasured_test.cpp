#include "report/screen/unmeasured.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace triptych::report {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

record::Record skipped_record(const std::string& device, const std::string& detail) {
  record::Record record;
  record.device = device;
  record.outcome = record::Outcome::skipped;
  record.reason = {.cause = record::Cause::not_supported, .detail = detail};
  return record;
}

TEST(Unmeasured, MeasuredRecordsHaveNoReason) {
  Unmeasured unmeasured;
  record::Record measured;
  measured.outcome = record::Outcome::measured;
  unmeasured.add(measured);
  EXPECT_THAT(unmeasured.lines(), IsEmpty());
}

TEST(Unmeasured, EqualReasonsAreCountedTogetherAndTheLargestGroupComesFirst) {
  Unmeasured unmeasured;
  unmeasured.add(skipped_record("a", "no compute\n"));
  for (const char* device : {"b", "a", "b"}) unmeasured.add(skipped_record(device, "no file"));
  record::Record not_tried = skipped_record("a", "no file");
  not_tried.reason.not_tried = true;
  unmeasured.add(not_tried);
  EXPECT_THAT(unmeasured.lines(),
              ElementsAre("4 skipped on a, b: no file", "1 skipped on a: no compute\\n"));
}

TEST(Unmeasured, FurtherReasonsAreOnlyCounted) {
  Unmeasured unmeasured;
  for (int reason = 0; reason < 11; ++reason)
    unmeasured.add(skipped_record("a", std::to_string(reason)));
  const std::vector<std::string> lines = unmeasured.lines();
  ASSERT_THAT(lines, SizeIs(Unmeasured::most_lines + 1));
  EXPECT_THAT(lines.back(), testing::StartsWith("3 more configurations were not measured for 3 "));
}

}  // namespace
}  // namespace triptych::report
