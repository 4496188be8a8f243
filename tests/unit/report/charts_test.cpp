// What the charts draw.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "judge/correlation/line.hpp"
#include "report/correlation_chart.hpp"
#include "report/page_frame.hpp"
#include "support/draw_charts.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::report {
namespace {

using testing::HasSubstr;

// The first configuration is off the line.
judge::CorrelationPair some_pair(std::size_t points = 24) {
  judge::CorrelationPair pair{.device_a = "gl:x", .device_b = "gl:y", .signal = "cost"};
  for (std::size_t i = 0; i < points; ++i) {
    const double x = 14 + 0.1 * static_cast<double>(i);
    pair.points.push_back({.configuration = fmt::format("data=d{}", i), .x = x, .y = x + 0.5});
  }
  pair.points[0].outlier = true;
  pair.points[0].y += 0.5;
  judge::fit_line(pair);
  return pair;
}

test::DrawnCharts drawn(const judge::CorrelationPair& pair) {
  const test::TemporaryFolder folder;
  return test::draw_charts(folder.write("page.html", chart("pair", correlation_chart(pair))));
}

TEST(CorrelationChart, Draws) {
  const test::DrawnCharts charts = drawn(some_pair());
  EXPECT_TRUE(charts.all) << charts.text;
  EXPECT_THAT(charts.text, HasSubstr("#pair: "));
}

// "<!--" and "<script" together hide the end of the script that they are in.
TEST(Chart, NamesCannotEndOrHideItsScript) {
  judge::CorrelationPair pair = some_pair();
  pair.points[0].configuration = "data=<!--<script>.nrrd";
  const test::DrawnCharts charts = drawn(pair);
  EXPECT_TRUE(charts.all) << charts.text;
  const std::string text = chart("c", R"({"title": "<!--<script></script>"})");
  EXPECT_THAT(text, HasSubstr(R"("\u003c!--\u003cscript>\u003c/script>")"));
}

TEST(CorrelationChart, DrawsARefusedPair) {
  const judge::CorrelationPair pair = some_pair(3);
  ASSERT_FALSE(pair.line.admitted());
  const test::DrawnCharts charts = drawn(pair);
  EXPECT_TRUE(charts.all) << charts.text;
}

// The test of the tests: the drawing tells a chart that draws nothing from one that does.
TEST(DrawCharts, TellsWhatDrawsNothing) {
  const test::TemporaryFolder folder;
  const auto of = [&](const std::string& specification) {
    return test::draw_charts(folder.write("page.html", chart("x", specification)));
  };
  const std::string one = R"({"data": {"values": [{"a": 1}]}, "mark": )";
  EXPECT_TRUE(of(one + R"("point", "encoding": {"x": {"field": "a"}}})").all);
  EXPECT_FALSE(of(R"({"data": {"values": []}, "mark": "point"})").all) << "no data";
  EXPECT_FALSE(of(one + R"("pint"})").all) << "no such mark";
  EXPECT_FALSE(of(one + R"("point", "encoding": {"xx": {"field": "a"}}})").all)
      << "no such channel";
}

}  // namespace
}  // namespace triptych::report
