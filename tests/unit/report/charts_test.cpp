// What the charts draw.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "report/page_frame.hpp"
#include "support/draw_charts.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::report {
namespace {

using testing::HasSubstr;

// "<!--" and "<script" together hide the end of the script that they are in.
TEST(Chart, NamesCannotEndOrHideItsScript) {
  const test::TemporaryFolder folder;
  const std::string named = chart(
      "c", R"({"title": "<!--<script></script>", "data": {"values": [{"a": 1}]}, "mark": "point",
               "encoding": {"x": {"field": "a"}}})");
  EXPECT_TRUE(test::draw_charts(folder.write("page.html", named)).all);
  const std::string text = chart("c", R"({"title": "<!--<script></script>"})");
  EXPECT_THAT(text, HasSubstr(R"("\u003c!--\u003cscript>\u003c/script>")"));
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
