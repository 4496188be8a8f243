// What the charts draw.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/json.hpp"
#include "report/correlation_chart.hpp"
#include "report/page_frame.hpp"
#include "report/page_sections.hpp"
#include "support/draw_charts.hpp"
#include "support/temporary_folder.hpp"
#include "tests/unit/judge/correlation_bench.hpp"

namespace triptych::report {
namespace {

using testing::HasSubstr;

// `slower`: by so much in ln t is the first configuration.
judge::CorrelationPair some_pair(double slower) {
  judge::CorrelationPair pair;
  pair.device = "gl:x";
  pair.other = "gl:y";
  pair.cases = judge::CorrelationBench{.noise = 0.01}.draw(1);
  pair.cases[0].log_time_b += slower;
  pair.result = judge::correlate(pair.cases);
  return pair;
}

test::DrawnCharts drawn(const judge::CorrelationPair& pair) {
  const test::TemporaryFolder folder;
  return test::draw_charts(folder.write("page.html", chart("pair", correlation_chart(pair))));
}

TEST(CorrelationChart, Draws) {
  const test::DrawnCharts charts = drawn(some_pair(0.5));
  EXPECT_TRUE(charts.all) << charts.text;
  EXPECT_THAT(charts.text, HasSubstr("#pair: "));
}

TEST(CorrelationChart, DrawsWhereNothingIsNamed) {
  const test::DrawnCharts charts = drawn(some_pair(0));
  EXPECT_TRUE(charts.all) << charts.text;
}

// "<!--" and "<script" together hide the end of the script that they are in.
TEST(Chart, NamesCannotEndOrHideItsScript) {
  judge::CorrelationPair pair = some_pair(0.5);
  pair.cases[0].configuration = "data=<!--<script>.nrrd";
  const test::DrawnCharts charts = drawn(pair);
  EXPECT_TRUE(charts.all) << charts.text;
  const std::string text = chart("c", R"({"title": "<!--<script></script>"})");
  EXPECT_THAT(text, HasSubstr(R"("\u003c!--\u003cscript>\u003c/script>")"));
}

TEST(CorrelationChart, DrawsARefusedPair) {
  judge::CorrelationPair pair = some_pair(0);
  pair.cases.resize(3);
  pair.result = judge::correlate(pair.cases);
  ASSERT_FALSE(pair.result.admitted());
  const test::DrawnCharts charts = drawn(pair);
  EXPECT_TRUE(charts.all) << charts.text;
}

// Anchors that lie far off would press the configurations together.
TEST(CorrelationChart, DeviationsReachAsFarAsTheConfigurations) {
  judge::CorrelationPair pair = some_pair(0.5);
  const auto anchor = std::ranges::find(pair.cases, true, &judge::CorrelationCase::anchor);
  ASSERT_NE(anchor, pair.cases.end());
  anchor->log_time_b += 3;
  pair.result = judge::correlate(pair.cases);
  const core::Json deviations =
      core::Json::parse(correlation_chart(pair)).at("hconcat").at(1).at("layer").at(2);
  const core::Json domain = deviations.at("encoding").at("y").at("scale").at("domain");
  const double slower = std::expm1(pair.result.judgements[0].residual);
  EXPECT_NEAR(domain.at(1).get<double>(), 1.1 * slower, 1e-9);
  EXPECT_EQ(deviations.at("mark").at("clip"), true);
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

// What decides stands in sight, and a device's own history that cannot judge with it; the others
// are folded away.
TEST(CorrelationSection, FoldsWhatDoesNotDecide) {
  judge::CorrelationPair by_nearest = some_pair(0);
  by_nearest.decides = true;
  judge::CorrelationPair by_farther = some_pair(0);
  by_farther.other = "gl:farther";
  judge::CorrelationPair by_itself = some_pair(0);
  by_itself.other = by_itself.device;
  by_itself.of_itself = true;
  by_itself.cases.resize(3);
  by_itself.result = judge::correlate(by_itself.cases);
  const judge::GateResult verdict{.correlations = {by_nearest, by_farther, by_itself}};
  const std::string text = correlation_section({.anchor = "plan", .verdict = &verdict});
  const auto folded = text.find("<details>");
  ASSERT_NE(folded, std::string::npos) << text;
  EXPECT_LT(text.find("gl:x against gl:y"), folded);
  EXPECT_LT(text.find("gl:x against its own history"), folded);
  EXPECT_GT(text.find("gl:x against gl:farther"), folded);
}

}  // namespace
}  // namespace triptych::report
