#include "comparison/side_by_side.hpp"

#include <fmt/format.h>
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
  EXPECT_THAT(report::words::sentence(*table),
              HasSubstr("gl:x has the lowest cost in 2 of the 2 techniques measured on it "
                        "(significantly in 0); the cost on gl:y is 2.00"));
  EXPECT_THAT(report::screen_of(*table), HasSubstr("\nbest  a 10 ms  a 20 ms   b 20 ms   \n"));
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

// Returns a record with the times `ms`.
record::Record with_times(const std::string& device, const std::string& run,
                          const std::vector<double>& ms) {
  record::Record record = measured(device, "a", "1", 0);
  record.run = run;
  record.wall_ns.clear();
  for (const double each : ms) record.wall_ns.push_back(1e6 * each);
  return record;
}

// Each device has the variance s² = 4·0.01²/3 of ln(time) and four frames, so the variance of each
// median is (π/2)·s²/4 with three degrees of freedom. The 99 % quantile of Student's distribution
// with 3 + 3 degrees of freedom is 3.1427.
TEST(SideBySide, OneRunGivesIntervalsFromItsFrames) {
  const double up = std::exp(0.01);
  const auto table_for = [&](double factor) {
    return side_by_side(
        std::vector{with_times("gl:x", "1", {1 / up, up, 1 / up, up}),
                    with_times("gl:y", "1", {factor / up, factor * up, factor / up, factor * up})});
  };
  const auto table = table_for(1.2);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->process_runs, 1U);
  const SideBySide::Cell& cell = table->rows.at(0).cells.at("gl:y");
  ASSERT_TRUE(cell.interval);
  EXPECT_NEAR(cell.interval->low, std::log(1.2) - 0.03216, 1e-4);
  EXPECT_NEAR(cell.interval->high, std::log(1.2) + 0.03216, 1e-4);
  EXPECT_TRUE(table->rows.at(0).is_significant());
  EXPECT_THAT(report::screen_of(*table), HasSubstr("  1.20 ±3%"));
  const auto close = table_for(1.02);
  EXPECT_FALSE(close->rows.at(0).is_significant());
  EXPECT_THAT(report::screen_of(*close), HasSubstr("  ~1.02 ±3%"));
  const core::Json json = report::to_json(*close)["rows"][0]["devices"]["gl:y"];
  EXPECT_EQ(json["significant"], false);
  EXPECT_NEAR(json["ratio_high"], 1.02 * std::exp(0.03216), 1e-4);
}

// The times of the three runs differ by 10 %, which the frames of one run do not show. The mean of
// three runs has the variance 0.01/3 with two degrees of freedom. The 99 % quantile of Student's
// distribution with 2 + 2 degrees of freedom is 3.7469.
TEST(SideBySide, SeveralRunsGiveIntervalsFromTheirVariation) {
  std::vector<record::Record> records;
  for (const double shift : {0.1, 0.0, -0.1}) {
    const double ms = std::exp(shift);
    const std::string run = fmt::format("{}", shift);
    records.push_back(with_times("gl:x", run, {ms, ms}));
    records.push_back(with_times("gl:y", run, {2 * ms, 2 * ms}));
  }
  const auto table = side_by_side(records);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->process_runs, 3U);
  const SideBySide::Cell& cell = table->rows.at(0).cells.at("gl:y");
  EXPECT_NEAR(cell.ratio, 2, 1e-12);
  EXPECT_NEAR(cell.interval->high - std::log(2), 0.30593, 1e-4);
  // A run that lacks a configuration of the row is not used.
  records.push_back(records.back());
  records.back().configuration = "step=2,technique=a";
  records.back().run = records[1].run;
  records.push_back(records[0]);
  records.back().configuration = "step=2,technique=a";
  EXPECT_EQ(side_by_side(records)->process_runs, 1U);
}

TEST(SideBySide, OneDeviceGivesNoTable) {
  const std::vector<record::Record> records{measured("gl:x", "a", "1", 10)};
  EXPECT_FALSE(side_by_side(records));
}

}  // namespace
}  // namespace triptych::comparison
