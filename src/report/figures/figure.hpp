#pragma once
// Figures as SVG: marks on two axes. They are drawn when the page is written. The colours come from
// the style sheet (classes c0…c7, ink, soft), so that a figure follows the page into dark mode.

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
  bool percent = false;  // numbers are shares: 0.1 is "+10 %"
  // Bands instead of numbers: name i is at i, the first one at the top or at the left.
  std::vector<std::string> names = {};
  // The ends of the axis. By default, the axis fits the data.
  std::optional<double> low = {};
  std::optional<double> high = {};
  // Values that the axis contains even if nothing is drawn at them. Figures with the same values
  // share their axis, so that a reader can compare them.
  std::vector<double> contains = {};
};

// Multiples of 1, 2 or 5 times a power of ten within [low, high], about `wanted` of them. On a
// logarithmic axis these are powers of ten, or also their multiples if there would be too few.
[[nodiscard]] std::vector<double> ticks(double low, double high, bool logarithmic, int wanted);
// "0.05", "1e-6", "25k", "3M"
[[nodiscard]] std::string short_number(double value);

enum class Mark { circle, triangle, cross, diamond, square };

struct Style {
  // A colour of the style sheet: "c0"…"c7", "ink", "soft".
  std::string_view colour = "c0";
  Mark mark = Mark::circle;
  bool dashed = false;
  bool hollow = false;
  double opacity = 1;
  double width = 1.2;  // width of lines
};
// The colour for the n-th of several; the ninth looks like the first.
constexpr std::size_t colour_count = 8;
[[nodiscard]] std::string_view colour_of(std::size_t index);

class Figure {
 public:
  struct Place {
    double x, y;
  };
  // `description` is the text for people who cannot see the figure. Width and height are those of
  // the frame inside the axes; the whole figure is larger by the space for its labels.
  Figure(std::string description, Axis across, Axis up, double width, double height);

  // A value that cannot be shown on an axis (NaN, or on a logarithmic axis one that is not above 0)
  // is left out.
  void point(Place at, const Style& style, std::string_view tooltip = {});
  void line(std::span<const Place> places, const Style& style, std::string_view tooltip = {});
  // A rectangle between two corners: bars, boxes, cells.
  void box(Place from, Place to, const Style& style, std::string_view tooltip = {});
  // Vertical strokes in one row, which extend by `half` of a band up and down: every sample of a
  // distribution.
  void strokes(std::span<const double> across, double row, double half, const Style& style);
  // A dashed vertical line across the whole frame, with its label beside it. The axis is not
  // extended to include it.
  void upright(double across, std::string_view label = {});
  // A label next to a point, inside the frame. It is left out if another label is already at this
  // place.
  void label(Place at, std::string_view text);
  void legend(std::string_view text, const Style& style, bool line = false);
  // The points and strokes that follow are data of this series, and are in the table that a reader
  // can save. Empty: they are not, because they repeat other data.
  void series(std::string_view name) { series_ = name; }

  // The element has the data as CSV in its attribute `data-csv`, if there are any.
  [[nodiscard]] Html svg() const;
  // One row for each value of a series: series, position across and upwards, tooltip.
  [[nodiscard]] std::string csv() const;
  // Whether there is nothing to show.
  [[nodiscard]] bool empty() const { return shapes_.empty(); }

 private:
  enum class Kind { point, line, box, strokes, upright, label };
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
  Axis across_;
  Axis up_;
  double width_;
  double height_;
  std::string series_;
  std::vector<Shape> shapes_;
  std::vector<Entry> entries_;
};

// Figures next to each other, each with a heading; they wrap on a narrow screen.
struct Titled {
  std::string title;
  Html svg;
};
[[nodiscard]] Html figures(std::span<const Titled> all);

}  // namespace triptych::report
