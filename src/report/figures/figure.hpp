#pragma once
// Figures as SVG: marks on two axes. The SVG is generated when the page is written. Its colours
// come from the style sheet (classes c0…c7, ink, soft), so that figures adapt to dark mode.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/html.hpp"

namespace triptych::report {

struct Axis {
  std::string title = {};
  bool logarithmic = false;
  bool percent = false;  // values are relative changes, labelled in percent: 0.1 is "+10 %"
  // If not empty, the axis has named categories instead of numbers. Category i is at position i;
  // the first one is at the top or on the left.
  std::vector<std::string> names = {};
  // The ends of the axis. By default, the axis covers the data.
  std::optional<double> low = {};
  std::optional<double> high = {};
  // Values that the axis covers in addition to the data. Figures with the same values here have the
  // same axis, so that readers can compare them.
  std::vector<double> contains = {};
};

// Returns about `wanted` ticks within [low, high]. The distance between ticks is 1, 2 or 5 times a
// power of ten. On a logarithmic axis, ticks are powers of ten and, if there are too few of them,
// also multiples of powers of ten.
[[nodiscard]] std::vector<double> ticks(double low, double high, bool logarithmic, int wanted);
// Formats a number briefly: "0.05", "1e-6", "25k", "3M".
[[nodiscard]] std::string short_number(double value);

enum class Mark { circle, triangle, cross, diamond, square };

struct Style {
  // The colour, as a class of the style sheet: "c0"…"c7", "ink" or "soft".
  std::string_view colour = "c0";
  Mark mark = Mark::circle;
  bool dashed = false;
  bool hollow = false;
  double opacity = 1;
  double width = 1.2;  // width of lines
};
constexpr std::size_t colour_count = 8;
// Returns the colour of the series with this index. After colour_count series, the colours repeat.
[[nodiscard]] std::string_view colour_of(std::size_t index);

class Figure {
 public:
  struct Place {
    double x, y;
  };
  // `description` is the alternative text for people who cannot see the figure. `width` and
  // `height` are the size of the area inside the axes; the labels need additional space.
  Figure(std::string description, Axis across, Axis up, double width, double height);

  // The following functions add marks. Values that an axis cannot show are left out: NaN and, on a
  // logarithmic axis, values that are not above 0.
  void point(Place at, const Style& style, std::string_view tooltip = {});
  void line(std::span<const Place> places, const Style& style, std::string_view tooltip = {});
  // Adds a rectangle between two corners, such as a bar or a box.
  void box(Place from, Place to, const Style& style, std::string_view tooltip = {});
  // Adds vertical strokes at height `row`, one for each sample of a distribution. Each stroke
  // extends by `half` up and down, in units of the vertical axis.
  void strokes(std::span<const double> across, double row, double half, const Style& style);
  // Adds a dashed vertical line from the bottom to the top, with a label next to it. The axis is
  // not extended to include it.
  void vertical_line(double across, std::string_view label = {});
  // Adds a label next to a point. It is left out if it would overlap another label.
  void label(Place at, std::string_view text);
  void legend(std::string_view text, const Style& style, bool line = false);
  // Starts a series. The points and strokes that are added after this call belong to it and are
  // exported as CSV. After a call with "", they are not exported, because they repeat other data.
  void series(std::string_view name) { series_ = name; }

  // Returns the figure as an SVG element. Its attribute `data-csv` contains the result of csv(), if
  // there are any series.
  [[nodiscard]] Html svg() const;
  // Returns the data as CSV, with one row for each value of a series: series, horizontal position,
  // vertical position, tooltip.
  [[nodiscard]] std::string csv() const;
  // Returns whether the figure contains no marks.
  [[nodiscard]] bool empty() const { return shapes_.empty(); }

 private:
  enum class Kind { point, line, box, strokes, vertical_line, label };
  struct Shape {
    Kind kind;
    std::vector<Place> places;
    Style style;
    std::string text;
    double half = 0;
    std::string series = {};
  };
  struct Entry {
    std::string text;
    Style style;
    bool line;
  };
  class Drawing;

  void add(Shape shape);

  std::string description_;
  Axis x_axis_;
  Axis y_axis_;
  double width_;
  double height_;
  std::string series_;
  std::vector<Shape> shapes_;
  std::vector<Entry> entries_;
};

struct TitledFigure {
  std::string title;
  Html svg;
};
// Arranges figures next to each other, each with its title as a heading. On a narrow screen, the
// figures wrap.
[[nodiscard]] Html figures(std::span<const TitledFigure> all);

}  // namespace triptych::report
