// What the charts draw.

#include "report/charts.hpp"

#include <gmock/gmock.h>

#include "core/json.hpp"
#include "report/analysis_charts.hpp"
#include "report/page_sections.hpp"
#include "report/scatter_figure.hpp"
#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using core::Json;
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
  scatter.shows_from = 0.2;
  return scatter;
}

TEST(ScatterChart, ShowsPointsLineAndWhatIsOffIt) {
  const std::string html = scatter_chart(some_scatter());
  EXPECT_EQ(xml_fault(html), "") << html;
  EXPECT_EQ(count(html, "<svg class=\"figure\""), 2U);
  EXPECT_EQ(count(html, "<title>step="), 10U);
  EXPECT_THAT(html, HasSubstr("step=3: 6 against 3, +50.0 %, slower"));
  EXPECT_THAT(html, HasSubstr(">+50 %<"));
  EXPECT_THAT(html, HasSubstr("the fitted line"));
  EXPECT_THAT(html, HasSubstr(">slices<"));
}

TEST(ScatterChart, WithoutALineShowsPointsAlone) {
  ScatterFigure scatter = some_scatter();
  scatter.line.reset();
  EXPECT_EQ(count(scatter_chart(scatter), "<svg class=\"figure\""), 1U);
  scatter.points.clear();
  EXPECT_EQ(scatter_chart(scatter), "");
}

TEST(TimeChart, HasAFigureForEachSceneAndARowForEachDevice) {
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
  const std::string html = time_chart(plan);
  EXPECT_EQ(xml_fault(html), "") << html;
  EXPECT_EQ(count(html, "<svg class=\"figure\""), 2U);
  EXPECT_THAT(html, HasSubstr("gl:&lt;y&gt; raycast: median 2.00 ms"));
  EXPECT_EQ(time_chart({}), "");
}

TEST(AnalysisCharts, DrawRowsAndLeaveOutNull) {
  const Json bins =
      Json::array({{{"from_ms", 1.0}, {"to_ms", 2.0}, {"count", 3}, {"expected", 2.5}},
                   {{"from_ms", 2.0}, {"to_ms", 4.0}, {"count", 1}, {"expected", nullptr}}});
  for (const bool logarithmic : {false, true}) {
    const std::string svg = histogram_chart(bins, logarithmic);
    EXPECT_EQ(xml_fault(svg), "") << svg;
    EXPECT_THAT(svg, HasSubstr("1 to 2 ms: 3, expected 2.5"));
  }
  const Json cells =
      Json::array({{{"factor", "step"}, {"a", "1"}, {"b", "2"}, {"r", 0.5}, {"pairs", 4}},
                   {{"factor", "step"}, {"a", "1"}, {"b", "4"}, {"r", nullptr}, {"pairs", 0}},
                   {{"factor", "step"}, {"a", "2"}, {"b", "4"}, {"r", 0.25}, {"pairs", 4}}});
  const std::string matrix = correlation_matrix_chart(cells);
  EXPECT_EQ(xml_fault(matrix), "") << matrix;
  EXPECT_EQ(count(matrix, ">0.50<"), 2U);  // both ways
  EXPECT_EQ(count(matrix, ">0.00<"), 0U);
  const std::string boxes = correlation_boxes_chart(cells);
  EXPECT_EQ(xml_fault(boxes), "");
  EXPECT_EQ(count(boxes, "<rect class=\"fill"), 0U);  // two values are no box
  const Json means =
      Json::array({{{"row", "a"}, {"column", "b"}, {"mean_ms", 1.5}, {"samples", 2}},
                   {{"row", "c"}, {"column", "b"}, {"mean_ms", nullptr}, {"samples", 0}}});
  EXPECT_EQ(count(mean_times_chart(means), "<rect class=\"fill"), 1U);
  const Json speed_ups = Json::array({{{"level", "2"},
                                       {"reference", "1"},
                                       {"speed_up", 1.8},
                                       {"error", 0.1},
                                       {"low", 1.7},
                                       {"high", 1.9},
                                       {"r", 0.9}}});
  EXPECT_THAT(speed_ups_chart(speed_ups), HasSubstr("2 against 1: 1.8 ± 0.1, r 0.900"));
  EXPECT_EQ(correlation_boxes_chart(Json::array()), "");
}

// What moved stands in sight, the other pairs are folded away.
TEST(CorrelationSection, FoldsPairsInWhichNothingMoved) {
  judge::CorrelationPair moved{.device_a = "gl:x", .device_b = "gl:y", .signal = "cost"};
  for (int i = 0; i < 3; ++i) {
    moved.points.push_back({.configuration = "technique=raycast", .x = 14.0 + i, .y = 15.0 + i});
  }
  judge::CorrelationPair quiet = moved;
  quiet.device_b = "gl:quiet";
  moved.points[0].outlier = true;
  const judge::GateResult verdict{.correlations = {moved, quiet}};
  const std::string text = correlation_section({.anchor = "plan", .verdict = &verdict});
  const auto folded = text.find("<details>");
  ASSERT_NE(folded, std::string::npos) << text;
  EXPECT_LT(text.find("gl:y against gl:x"), folded);
  EXPECT_GT(text.find("gl:quiet against gl:x"), folded);
}

}  // namespace
}  // namespace triptych::report
