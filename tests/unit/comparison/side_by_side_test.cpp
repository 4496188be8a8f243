#include "comparison/side_by_side.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "report/exports/comparison_json.hpp"
#include "report/screen/device_table.hpp"
#include "report/words/comparison.hpp"

namespace triptych::comparison {
namespace {

using testing::HasSubstr;

record::Record measured(const std::string& device, const std::string& technique,
                        const std::string& step, std::uint64_t instructions) {
  record::Record record;
  record.device = device;
  record.technique = technique;
  record.configuration = "step=" + step + ",technique=" + technique;
  record.outcome = record::Outcome::measured;
  record.wall_ns = {1e6 * static_cast<double>(instructions)};
  if (instructions > 0) record.cost = {{"device_code", instructions}, {"libc", 7}};
  record.counters = {{"samples", 100}};
  return record;
}

TEST(SideBySide, IsTheGeometricMeanOverWhatAllMeasured) {
  std::vector<record::Record> records{
      measured("gl:x", "a", "1", 100), measured("vulkan:y", "a", "1", 200),
      measured("gl:x", "a", "2", 100), measured("vulkan:y", "a", "2", 80),
      measured("gl:x", "a", "3", 1),  // measured by no other device, so not compared
      measured("gl:x", "b", "1", 30),  measured("vulkan:y", "b", "1", 10)};
  records[1].counters["samples"] = 150;
  const auto table = side_by_side(records);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->unit, "instructions");
  ASSERT_EQ(table->rows.size(), 2U);
  EXPECT_EQ(table->rows[0].configurations, 2U);
  EXPECT_NEAR(table->rows[0].cells.at("vulkan:y").ratio, std::sqrt(1.6), 1e-12);
  EXPECT_NEAR(table->rows[1].cells.at("gl:x").ratio, 3, 1e-12);
  EXPECT_EQ(table->rows[1].best, "vulkan:y");
  EXPECT_THAT(report::screen_of(*table), HasSubstr("1.26 (samples ×1.22)"));
  EXPECT_THAT(report::screen_of(*table), HasSubstr("best  a 0.0001 M  a 0.000126 M"))
      << "b has fewer configurations";
  EXPECT_EQ(report::to_json(*table)["rows"][1]["best"], "vulkan:y");
}

TEST(SideBySide, UsesTimesIfNothingWasCountedAndReportsOmissions) {
  std::vector<record::Record> records{
      measured("gl:x", "a", "1", 10), measured("gl:y", "a", "1", 20),
      measured("gl:z", "b", "1", 20), measured("gl:x", "b", "1", 10)};
  for (record::Record& each : records) each.cost.clear();
  const auto table = side_by_side(records);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->unit, "ns");
  EXPECT_THAT(report::screen_of(*table), HasSubstr("–"));
  EXPECT_THAT(
      report::words::sentence(*table),
      HasSubstr("gl:x has the lowest cost in 2 of the 2 techniques measured on it; the cost on "
                "gl:y is 2.00"));
  EXPECT_THAT(report::screen_of(*table), HasSubstr("\nbest  a 10 ms  a 20 ms  b 20 ms  \n"));
}

// Device clocks report shorter times than the wall clock, so times are compared only if they come
// from the same kind of clock.
TEST(SideBySide, ComparesTimesOnOneClock) {
  std::vector<record::Record> records{measured("gl:x", "a", "1", 10),
                                      measured("gl:y", "a", "1", 20)};
  for (record::Record& each : records) {
    each.cost.clear();
    each.device_ns = {4e6};
  }
  records[1].device_clock_trusted = true;
  EXPECT_EQ(side_by_side(records)->rows.at(0).best, "gl:x");
  EXPECT_THAT(report::screen_of(*side_by_side(records)), HasSubstr("Time (wall clock) per frame"));
  records[0].device_clock_trusted = true;
  records[0].device_ns = {5e6};
  EXPECT_EQ(side_by_side(records)->rows.at(0).best, "gl:y");
  EXPECT_EQ(report::to_json(*side_by_side(records))["clock"], "device");
}

TEST(SideBySide, OneDeviceGivesNoTable) {
  const std::vector<record::Record> records{measured("gl:x", "a", "1", 10)};
  EXPECT_FALSE(side_by_side(records));
}

}  // namespace
}  // namespace triptych::comparison
