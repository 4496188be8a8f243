// Tests the contents of the charts.

#include "report/page/charts.hpp"

#include <gmock/gmock.h>

#include "report/figures/scatter_figure.hpp"
#include "report/page/page_sections.hpp"
#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using test::xml_fault;
using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, std::string_view what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

ScatterFigure some_scatter() {
  ScatterFigure scatter{.across = "gl:y, ms", .up = "gl:x, ms", .points = {}};
  for (int i = 1; i <= 5; ++i) {
    scatter.points.push_back({.name = "step=" + std::to_string(i),
                              .technique = i < 3 ? "raycast" : "slices",
                              .across = i * 1.0,
                              .up = i * 2.0,
                              .deviation = 0.01 * i});
  }
  scatter.points[2].flag = "slower";
  scatter.points[2].deviation = 0.5;
  scatter.line = {std::log(2.0), 1};
  scatter.reporting_threshold = 0.2;
  return scatter;
}

TEST(ScatterChart, ShowsPointsLineAndOutliers) {
  const std::string html = scatter_chart(some_scatter()).text();
  EXPECT_EQ(xml_fault(html), "") << html;
  EXPECT_EQ(count(html, "<svg class=\"figure\""), 2U);
  EXPECT_EQ(count(html, "<title>step="), 10U);
  EXPECT_THAT(html, HasSubstr("step=3: 6 against 3, +50.0 %, slower"));
  EXPECT_THAT(html, HasSubstr(">+50 %<"));
  EXPECT_THAT(html, HasSubstr("the fitted line"));
  EXPECT_THAT(html, HasSubstr(">slices<"));
}

TEST(ScatterChart, ShowsOnlyPointsWithoutALine) {
  ScatterFigure scatter = some_scatter();
  scatter.line.reset();
  EXPECT_EQ(count(scatter_chart(scatter).text(), "<svg class=\"figure\""), 1U);
  scatter.points.clear();
  EXPECT_EQ(scatter_chart(scatter).text(), "");
}

TEST(TimeChart, HasAFigurePerSceneAndARowPerDevice) {
  PlanData plan;
  for (const auto& [device, step] : {std::pair("gl:x", "1"), {"gl:<y>", "1"}, {"gl:x", "2"}}) {
    record::Record record;
    record.device = device;
    record.technique = "raycast";
    record.configuration = std::string("step=") + step + ",technique=raycast";
    record.outcome = record::Outcome::measured;
    record.wall_ns = {1e6, 2e6, 4e6};
    plan.records.push_back(record);
  }
  const std::string html = time_chart(plan).text();
  EXPECT_EQ(xml_fault(html), "") << html;
  EXPECT_EQ(count(html, "<svg class=\"figure\""), 2U);
  EXPECT_THAT(html, HasSubstr("gl:&lt;y&gt; raycast: median 2.00 ms"));
  EXPECT_EQ(time_chart({}).text(), "");
}

// Dispatches and draws are timed by different clocks, and one of them may not be trustworthy. Two
// times may be divided only if they come from the same clock.
TEST(SpeedOfLight, DividesTimesOnOneClock) {
  PlanData plan;
  for (const char* technique : {"raycast", "speed_of_light"}) {
    record::Record record;
    record.device = "gl:x";
    record.technique = technique;
    record.configuration = std::string("step=1,technique=") + technique;
    record.outcome = record::Outcome::measured;
    const bool bound = record.technique == "speed_of_light";
    record.wall_ns = {bound ? 5e6 : 6e6};
    record.device_ns = {bound ? 1e6 : 4e6};
    record.device_clock_trusted = bound;
    plan.records.push_back(record);
  }
  EXPECT_THAT(speed_of_light_section(plan).text(), HasSubstr(">1.20<"));
  plan.records[0].device_clock_trusted = true;
  EXPECT_THAT(speed_of_light_section(plan).text(), HasSubstr(">4.00<"));
}

TEST(TimesSection, StatesWhetherTimesDecided) {
  record::Record record;
  record.outcome = record::Outcome::measured;
  record.wall_ns = {1e6, 2e6};
  judge::GateResult verdict;
  const PlanData plan{.prefix = "plan", .devices = {}, .records = {record}, .verdict = &verdict};
  EXPECT_THAT(times_section(plan).text(), HasSubstr("Times: shown, not judged"));
  verdict.times_decided = true;
  EXPECT_THAT(times_section(plan).text(), Not(HasSubstr("not judged")));
}

// Pairs of devices with an outlier are shown; all other pairs are folded.
TEST(CorrelationSection, FoldsPairsInWhichNothingMoved) {
  judge::CorrelationPair moved{.device_a = "gl:x", .device_b = "gl:y", .signal = "cost"};
  for (int i = 0; i < 3; ++i) {
    moved.points.push_back({.configuration = "technique=raycast", .x = 14.0 + i, .y = 15.0 + i});
  }
  judge::CorrelationPair quiet = moved;
  quiet.device_b = "gl:quiet";
  moved.points[0].outlier = true;
  const judge::GateResult verdict{.correlations = {moved, quiet}};
  const std::string text = correlation_section({.prefix = "plan", .verdict = &verdict}).text();
  const auto folded = text.find("<details>");
  ASSERT_NE(folded, std::string::npos) << text;
  EXPECT_LT(text.find("gl:y against gl:x"), folded);
  EXPECT_GT(text.find("gl:quiet against gl:x"), folded);
}

}  // namespace
}  // namespace triptych::report
