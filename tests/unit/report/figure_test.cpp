#include "report/figures/figure.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <regex>

#include "core/random.hpp"
#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using test::xml_fault;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Ticks, AreWholeStepsWithinTheAxis) {
  EXPECT_THAT(ticks(0, 10, false, 5), ElementsAre(0, 2, 4, 6, 8, 10));
  EXPECT_THAT(ticks(-0.1, 0.1, false, 4),
              ElementsAre(testing::DoubleEq(-0.1), testing::DoubleEq(-0.05), 0,
                          testing::DoubleEq(0.05), testing::DoubleEq(0.1)));
  EXPECT_THAT(ticks(1, 1000, true, 5), ElementsAre(1, 10, 100, 1000));
  EXPECT_THAT(ticks(0.9, 6, true, 5), ElementsAre(1, 2, 5));
  EXPECT_THAT(ticks(1e-9, 1e9, true, 4).size(), testing::Le(5U));
  // A range within one decade has the same ticks as a linear axis.
  EXPECT_THAT(ticks(100, 102, true, 4).size(), testing::Ge(2U));
}

// Even a narrow figure must show at least two ticks, wherever its range begins and ends.
TEST(Ticks, AreAtLeastTwo) {
  core::Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const double low = std::pow(10, 6 * random.uniform() - 3);
    const double high = low * (1 + std::pow(10, 8 * random.uniform() - 4));
    for (const bool logarithmic : {false, true}) {
      for (const int wanted : {1, 2, 5}) {
        EXPECT_GE(ticks(low, high, logarithmic, wanted).size(), 2U) << low << " to " << high;
      }
    }
  }
}

TEST(Ticks, AreOneForAnEmptyRange) {
  EXPECT_EQ(ticks(3, 3, false, 5).size(), 1U);
  EXPECT_EQ(ticks(0, INFINITY, false, 5).size(), 1U);
}

TEST(ShortNumber, IsEasyToRead) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(0.05), "0.05");
  EXPECT_EQ(short_number(1e-6), "1e-6");
  EXPECT_EQ(short_number(1234), "1234");
  EXPECT_EQ(short_number(25000), "25k");
  EXPECT_EQ(short_number(-3e6), "-3M");
}

Figure some_figure(const std::string& text) {
  Figure figure(text, {.title = text, .logarithmic = true}, {.title = text}, 200, 100);
  figure.point({1, 2}, {}, text);
  figure.point({10, 4}, {.mark = Mark::cross}, text);
  figure.line(std::array{Figure::Place{1, 2}, Figure::Place{10, 4}}, {.dashed = true}, text);
  figure.box({2, 0}, {3, 4}, {.opacity = 0.5}, text);
  figure.label({10, 4}, text);
  figure.vertical_line(5, text);
  figure.legend(text, {});
  figure.series(text);
  figure.point({3, 3}, {}, text);
  return figure;
}

TEST(Figure, ARuleBeyondTheAxisIsNotDrawn) {
  Figure figure("rules", {.logarithmic = true}, {}, 200, 100);
  figure.point({1, 2}, {});
  figure.point({10, 4}, {});
  const std::string without = figure.svg().text();
  figure.vertical_line(1e-6);
  EXPECT_EQ(figure.svg().text(), without);
  figure.vertical_line(5);
  EXPECT_NE(figure.svg().text(), without);
}

TEST(Figure, ARuleHasItsLabelInsideTheFrame) {
  Figure figure("rules", {.low = 0, .high = 10}, {.low = 0, .high = 1}, 200, 100);
  figure.point({1, 0}, {});
  figure.vertical_line(5, "1/255");
  figure.vertical_line(5.2, "1/256");  // there is no space for this label beside the first one
  const std::string svg = figure.svg().text();
  EXPECT_THAT(svg, HasSubstr(">1/255</text>"));
  EXPECT_THAT(svg, Not(HasSubstr(">1/256</text>")));
}

TEST(Figure, ALogarithmicAxisIsMarked) {
  Figure figure("f", {.title = "error", .logarithmic = true}, {.title = "time"}, 200, 100);
  figure.point({1, 1}, {});
  EXPECT_THAT(figure.svg().text(), HasSubstr(">error (log)<"));
  EXPECT_THAT(figure.svg().text(), HasSubstr(">time<"));
}

// If two figures share an axis that contains the same values, a mark has the same position in both
// figures, whatever else they show.
TEST(Figure, SharesItsAxisByTheValuesItContains) {
  const std::vector<double> shared{1, 1000};
  const auto mark = [&](double other) {
    Figure figure("f", {.logarithmic = true, .contains = shared}, {}, 200, 100);
    figure.point({10, 1}, {});
    figure.point({other, 1}, {.colour = "c1"});
    const std::string svg = figure.svg().text();
    const auto begin = svg.find("class=\"fill c0\"");
    return svg.substr(begin, svg.find('>', begin) - begin);
  };
  EXPECT_EQ(mark(2), mark(900));
  EXPECT_NE(mark(2), mark(1e6)) << "beyond the shared values the axis grows";
}

TEST(Figure, ContainsItsDataAsATable) {
  Figure figure("f", {.title = "time, ms"}, {.names = {"gl:x", "gl:y"}}, 200, 100);
  figure.point({1, 0}, {}, "not data");
  EXPECT_THAT(figure.svg().text(), Not(HasSubstr("data-csv")));
  figure.series("raycast");
  figure.strokes(std::vector<double>{2, 0.5}, 1, 0.3, {});
  figure.point({3, 0}, {}, "a \"b\"");
  figure.line(std::array{Figure::Place{1, 0}, Figure::Place{3, 0}}, {});
  EXPECT_EQ(figure.csv(),
            "series,\"time, ms\",y,label\nraycast,0.5,gl:y,\nraycast,2,gl:y,\nraycast,3,gl:x,"
            "\"a \"\"b\"\"\"\n");
  EXPECT_THAT(figure.svg().text(), HasSubstr("data-csv=\"series,"));
}

TEST(Figure, IsWellFormedForAnyInput) {
  for (const std::string& text : test::hostile_strings()) {
    const std::string svg = some_figure(text).svg().text();
    EXPECT_EQ(xml_fault(svg), "");
    EXPECT_THAT(svg, Not(HasSubstr("<script")));
    Figure named(text, {.names = {text, "b"}}, {.names = {"a", text}}, 100, 50);
    named.box({0, 0}, {1, 1}, {}, text);
    EXPECT_EQ(xml_fault(named.svg().text()), "");
  }
}

TEST(Figure, DrawsNothingForInvalidNumbers) {
  Figure figure("f", {.logarithmic = true}, {}, 100, 50);
  figure.point({0, 1}, {});  // a logarithmic axis has no 0
  figure.point({1, NAN}, {});
  figure.box({1, 1}, {NAN, 2}, {});
  figure.line(std::array{Figure::Place{-1, 1}}, {});
  EXPECT_TRUE(figure.empty());
  const std::string svg = figure.svg().text();
  EXPECT_EQ(xml_fault(svg), "");
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(Figure, ABoxLiesBetweenItsCorners) {
  Figure figure("f", {.low = 0, .high = 10}, {.low = 0, .high = 10}, 100, 100);
  figure.box({2, 8}, {4, 3}, {});
  EXPECT_THAT(figure.svg().text(), HasSubstr("width=\"20.0\" height=\"50.0\""));
}

// Even if all values are equal, the axis must not have length zero.
TEST(Figure, OfOneValueHasAxes) {
  for (const bool logarithmic : {false, true}) {
    Figure figure("f", {.logarithmic = logarithmic}, {.logarithmic = logarithmic}, 100, 50);
    figure.point({5, 5}, {});
    EXPECT_THAT(figure.svg().text(), Not(HasSubstr("nan")));
    EXPECT_THAT(figure.svg().text(), HasSubstr(">5<"));
  }
}

// Assuming the estimated text width, every label must lie inside the view box.
TEST(Figure, LabelsStayInside) {
  Figure figure("f", {.title = "across"}, {.names = {"a device with a long name", "b"}}, 200, 60);
  figure.box({0, -0.3}, {1'000'000, 0.3}, {});
  figure.label({1'000'000, 0}, "at the right edge");
  const std::string svg = figure.svg().text();
  std::smatch size;
  ASSERT_TRUE(std::regex_search(svg, size, std::regex("viewBox=\"0 0 ([0-9]+) ([0-9]+)\"")));
  const std::regex text(
      "<text x=\"([0-9.-]+)\" y=\"([0-9.-]+)\" text-anchor=\"(\\w+)\"[^>]*>([^<]*)<");
  int seen = 0;
  for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end; ++at) {
    const double x = std::stod((*at)[1]);
    const double width = 6.3 * static_cast<double>((*at)[4].length());
    const double left = (*at)[3] == "end" ? x - width : (*at)[3] == "middle" ? x - width / 2 : x;
    EXPECT_GE(left, 0) << (*at)[0];
    EXPECT_LE(left + width, std::stod(size[1]) + 1) << (*at)[0];
    EXPECT_LE(std::stod((*at)[2]), std::stod(size[2])) << (*at)[0];
    ++seen;
  }
  EXPECT_GE(seen, 5);
}

TEST(Figure, LabelsDoNotCoverEachOther) {
  Figure figure("f", {}, {}, 200, 100);
  figure.point({0, 0}, {});
  figure.point({1, 1}, {});
  figure.label({0.2, 0.5}, "first");
  figure.label({0.2, 0.5}, "second");
  EXPECT_THAT(figure.svg().text(), HasSubstr("first"));
  EXPECT_THAT(figure.svg().text(), Not(HasSubstr("second")));
}

// Long names, such as lists of factors, may differ only in the middle.
TEST(Figure, ALegendDistinguishesLongNames) {
  Figure figure("", {}, {}, 100, 100);
  figure.point({1, 1}, {}, "");
  figure.legend("precision=fp32, quadrature=cells, sampler=manual", {});
  EXPECT_THAT(figure.svg().text(),
              HasSubstr(">precision=fp32, quadrature=cells, sampler=manual</text>"));
}

TEST(WellFormed, DetectsMalformedDocuments) {
  EXPECT_EQ(xml_fault("<a b=\"c\"><d/>x &amp; y</a>"), "");
  for (const char* bad : {"<a>", "<a></b>", "<a b=c/>", "<a b=\"<\"/>", "<a>&x;</a>", "<a/><a/>",
                          "<a b=\"1\" b=\"2\"/>", "<a>\x1b</a>", "x", "<a><b></a></b>"}) {
    EXPECT_NE(xml_fault(bad), "") << bad;
  }
}

}  // namespace
}  // namespace triptych::report
