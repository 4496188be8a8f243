#include "report/figures/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/figures/axis_scale.hpp"
#include "report/figures/figure_elements.hpp"
#include "report/html.hpp"

namespace triptych::report {
namespace {

constexpr double line_height = 16;
constexpr double gap = 8;
constexpr double letter_height = 12;

}  // namespace

// Computes the layout of a figure and generates its SVG.
class Figure::Drawing {
 public:
  explicit Drawing(const Figure& figure)
      : figure_(figure),
        x_axis_(measure(figure.x_axis_, &Place::x)),
        y_axis_(measure(figure.y_axis_, &Place::y)),
        x_ticks_(x_axis_.ticks(static_cast<int>(figure.width_ / 70))),
        y_ticks_(y_axis_.ticks(static_cast<int>(figure.height_ / 40))) {
    compute_layout();
  }

  Html svg() {
    for (const Shape& shape : figure_.shapes_) marks_ += element(shape);
    const std::string clip =
        fmt::format("{:.0f} {:.0f} {:.0f} {:.0f}", left_, top_, figure_.width_, figure_.height_);
    return markup(
               "<svg class=\"figure\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
               "height=\"{1:.0f}\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\"{2}>",
               total_width_, total_height_, data_attribute()) +
           title_element(figure_.description_) + legend() + axes() +
           markup(
               "<svg class=\"marks\" x=\"{0:.0f}\" y=\"{1:.0f}\" width=\"{2:.0f}\" "
               "height=\"{3:.0f}\" viewBox=\"{4}\">",
               left_, top_, figure_.width_, figure_.height_, clip) +
           marks_ + markup("</svg>") + labels_ + markup("</svg>");
  }

 private:
  // Computes the range of an axis so that it covers all data and Axis::contains.
  [[nodiscard]] AxisScale measure(const Axis& axis, double Place::*coordinate) const {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : axis.contains) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
    for (const Shape& shape : figure_.shapes_) {
      if (shape.kind == Kind::vertical_line) continue;
      for (const Place& place : shape.places) {
        low = std::min(low, place.*coordinate);
        high = std::max(high, place.*coordinate);
      }
    }
    return {axis, low, high};
  }

  void compute_layout() {
    left_ = widest_label(y_ticks_) + gap + (figure_.y_axis_.title.empty() ? 4 : line_height + 4);
    // Names that do not fit next to each other are rotated.
    const double band =
        figure_.width_ / static_cast<double>(std::max<std::size_t>(x_ticks_.size(), 1));
    const double widest = widest_label(x_ticks_);
    rotated_ = !figure_.x_axis_.names.empty() && widest + 4 > band;
    const double below = rotated_ ? widest + gap : line_height + 2;
    const double last = x_ticks_.empty() ? 0 : width_of(x_ticks_.back().text) / 2;
    total_width_ = left_ + figure_.width_ + std::max(rotated_ ? 0.0 : last, gap);
    place_legend();
    top_ = gap + legend_height_;
    total_height_ =
        top_ + figure_.height_ + below + (figure_.x_axis_.title.empty() ? 4 : line_height + 4);
  }

  void place_legend() {
    double x = left_;
    double row = 0;
    for (const Entry& entry : figure_.entries_) {
      const std::string text = shortened(entry.text, max_legend_length);
      const double width = width_of(text) + 30;
      if (x > left_ && x + width > total_width_) {
        x = left_;
        ++row;
      }
      total_width_ = std::max(total_width_, x + width);
      legend_positions_.push_back({x, gap + row * line_height + 8});
      x += width;
    }
    legend_height_ = legend_positions_.empty() ? 0 : (row + 1) * line_height + 4;
  }

  [[nodiscard]] Html legend() const {
    Html text;
    for (std::size_t i = 0; i < legend_positions_.size(); ++i) {
      const auto& [x, y] = legend_positions_[i];
      const Entry& entry = figure_.entries_[i];
      text += entry.line
                  ? markup("<path {} d=\"M{:.1f} {:.1f}h14\"/>", line_attributes(entry.style), x, y)
                  : mark_element(x + 8, y, entry.style, {});
      text +=
          markup("<g>{}{}</g>", title_element(entry.text),
                 text_element(x + 18, y + 4, "start", shortened(entry.text, max_legend_length)));
    }
    return text;
  }

  [[nodiscard]] double x_of(double value) const {
    return left_ + figure_.width_ * x_axis_.share(value);
  }
  // Categories are listed from top to bottom, but numbers increase from bottom to top.
  [[nodiscard]] double y_of(double value) const {
    const double share = y_axis_.share(value);
    return top_ + figure_.height_ * (figure_.y_axis_.names.empty() ? 1 - share : share);
  }

  [[nodiscard]] Html axes() const {
    const double bottom = top_ + figure_.height_;
    std::string grid;
    Html text;
    double next_free_x = -std::numeric_limits<double>::infinity();
    for (const auto& tick : x_ticks_) {
      const double x = x_of(tick.at);
      if (figure_.x_axis_.names.empty())
        grid += fmt::format("M{:.1f} {:.1f}v{:.0f}", x, top_, figure_.height_);
      const double half = width_of(tick.text) / 2;
      if (!rotated_ && x - half < next_free_x) continue;  // the label does not fit
      next_free_x = x + half + 4;
      const Html more =
          rotated_ ? markup(" transform=\"rotate(-90 {:.1f} {:.1f})\"", x + 4, bottom + 8) : Html();
      text += named(tick, rotated_ ? text_element(x + 4, bottom + 8, "end", tick.text, more)
                                   : text_element(x, bottom + line_height, "middle", tick.text));
    }
    for (const auto& tick : y_ticks_) {
      const double y = y_of(tick.at);
      if (figure_.y_axis_.names.empty())
        grid += fmt::format("M{:.1f} {:.1f}h{:.0f}", left_, y, figure_.width_);
      text += named(tick, text_element(left_ - gap, y + 4, "end", tick.text));
    }
    return markup(
               "<path class=\"grid\" d=\"{}\"/><rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" "
               "width=\"{:.0f}\" height=\"{:.0f}\"/>",
               grid.empty() ? "M0 0" : grid, left_, top_, figure_.width_, figure_.height_) +
           text + titles();
  }

  static Html named(const AxisScale::Tick& tick, const Html& element) {
    if (tick.whole.empty() || tick.whole == tick.text) return element;
    return markup("<g>{}{}</g>", title_element(tick.whole), element);
  }

  [[nodiscard]] Html data_attribute() const {
    const std::string csv = figure_.csv();
    return csv.empty() ? Html() : markup(" data-csv=\"{}\"", csv);
  }

  [[nodiscard]] static std::string title_of(const Axis& axis) {
    const bool logarithmic = axis.logarithmic && axis.names.empty();
    return shortened(axis.title) + (logarithmic ? " (log)" : "");
  }

  [[nodiscard]] Html titles() const {
    Html text;
    if (!figure_.x_axis_.title.empty()) {
      text += text_element(left_ + figure_.width_ / 2, total_height_ - 5, "middle",
                           title_of(figure_.x_axis_), markup(" class=\"axis\""));
    }
    if (!figure_.y_axis_.title.empty()) {
      const double y = top_ + figure_.height_ / 2;
      text += text_element(12, y, "middle", title_of(figure_.y_axis_),
                           markup(" class=\"axis\" transform=\"rotate(-90 12 {:.1f})\"", y));
    }
    return text;
  }

  Html element(const Shape& shape) {
    const Place& first = shape.places.front();
    switch (shape.kind) {
      case Kind::point:
        return mark_element(x_of(first.x), y_of(first.y), shape.style, shape.text);
      case Kind::line:
        return line_element(shape);
      case Kind::box:
        return box_element(shape);
      case Kind::strokes:
        return strokes_element(shape);
      case Kind::vertical_line:
        if (const double at = x_axis_.share(first.x); at < 0 || at > 1)
          return {};  // outside the frame
        label_vertical_line(shape);
        return markup("<path {} d=\"M{:.1f} {:.1f}v{:.0f}\"/>", line_attributes(shape.style),
                      x_of(first.x), top_, figure_.height_);
      case Kind::label:
        place_label(shape);
        break;
    }
    return {};
  }

  [[nodiscard]] Html line_element(const Shape& shape) const {
    std::string path;
    for (const Place& place : shape.places) {
      path +=
          fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_of(place.x), y_of(place.y));
    }
    return markup("<path {} d=\"{}\">{}</path>", line_attributes(shape.style), path,
                  title_element(shape.text));
  }

  [[nodiscard]] Html box_element(const Shape& shape) const {
    const auto [x0, x1] = std::minmax({x_of(shape.places[0].x), x_of(shape.places[1].x)});
    const auto [y0, y1] = std::minmax({y_of(shape.places[0].y), y_of(shape.places[1].y)});
    return markup(
        "<rect class=\"fill {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
        "opacity=\"{:.2f}\">{}</rect>",
        shape.style.colour, x0, y0, x1 - x0, y1 - y0, shape.style.opacity,
        title_element(shape.text));
  }

  [[nodiscard]] Html strokes_element(const Shape& shape) const {
    const double half = shape.half * std::abs(y_of(1) - y_of(0));
    std::string path;
    double last = -1;
    for (const Place& place : shape.places) {
      // Strokes that are rounded to the same position are drawn only once.
      const double x = std::round(2 * x_of(place.x)) / 2;
      if (x == last) continue;
      last = x;
      path += fmt::format("M{:.1f} {:.1f}v{:.1f}", x, y_of(place.y) - half, 2 * half);
    }
    return markup("<path {} d=\"{}\"/>", line_attributes(shape.style), path);
  }

  void place_label(const Shape& shape) {
    const double width = width_of(shape.text);
    double x = x_of(shape.places[0].x) + 7;
    const double right = left_ + figure_.width_;
    if (x + width > right) x -= width + 14;
    const double y = std::clamp(y_of(shape.places[0].y), top_ + 8, top_ + figure_.height_ - 8) + 4;
    if (x < left_ || !reserve({x, y - letter_height, width, letter_height})) return;
    labels_ += text_element(x, y, "start", shape.text, markup(" class=\"on\""));
  }

  // Draws the label rotated, so that it ends at the top of the frame. The label is to the left of
  // the line if there is space.
  void label_vertical_line(const Shape& shape) {
    if (shape.text.empty()) return;
    const double line = x_of(shape.places[0].x);
    const double x = line - letter_height < left_ ? line + letter_height - 1 : line - 3;
    const double y = top_ + 5;
    if (!reserve({x - letter_height, y, letter_height, width_of(shape.text)})) return;
    labels_ += text_element(x, y, "end", shape.text,
                            markup(" class=\"on\" transform=\"rotate(-90 {:.1f} {:.1f})\"", x, y));
  }

  struct Area {
    double x, y, width, height;
  };
  // Reserves an area for a label. Returns false if it overlaps another label.
  bool reserve(const Area& area) {
    const bool taken = std::ranges::any_of(label_areas_, [&](const Area& other) {
      return area.x < other.x + other.width && other.x < area.x + area.width &&
             area.y < other.y + other.height && other.y < area.y + area.height;
    });
    if (!taken) label_areas_.push_back(area);
    return !taken;
  }

  const Figure& figure_;
  AxisScale x_axis_;
  AxisScale y_axis_;
  std::vector<AxisScale::Tick> x_ticks_;
  std::vector<AxisScale::Tick> y_ticks_;
  double left_ = 0;
  double top_ = 0;
  double total_width_ = 0;
  double total_height_ = 0;
  double legend_height_ = 0;
  bool rotated_ = false;
  std::vector<Place> legend_positions_;
  std::vector<Area> label_areas_;
  Html marks_;
  Html labels_;
};

Figure::Figure(std::string description, Axis across, Axis up, double width, double height)
    : description_(std::move(description)),
      x_axis_(std::move(across)),
      y_axis_(std::move(up)),
      width_(width),
      height_(height) {}

void Figure::add(Shape shape) {
  const auto has_place = [](const Axis& axis, double value) {
    return std::isfinite(value) && (!axis.logarithmic || !axis.names.empty() || value > 0);
  };
  std::erase_if(shape.places, [&](const Place& place) {
    return !has_place(x_axis_, place.x) || !has_place(y_axis_, place.y);
  });
  const std::size_t needed = shape.kind == Kind::box ? 2 : 1;
  shape.series = series_;
  if (shape.places.size() >= needed) shapes_.push_back(std::move(shape));
}

void Figure::point(Place at, const Style& style, std::string_view tooltip) {
  add({Kind::point, {at}, style, std::string(tooltip)});
}

void Figure::line(std::span<const Place> places, const Style& style, std::string_view tooltip) {
  add({Kind::line, {places.begin(), places.end()}, style, std::string(tooltip)});
}

void Figure::box(Place from, Place to, const Style& style, std::string_view tooltip) {
  add({Kind::box, {from, to}, style, std::string(tooltip)});
}

void Figure::strokes(std::span<const double> across, double row, double half, const Style& style) {
  Shape shape{Kind::strokes, {}, style, {}, half};
  for (const double each : across) shape.places.push_back({each, row});
  std::ranges::sort(shape.places, {}, &Place::x);
  add(std::move(shape));
}

void Figure::vertical_line(double across, std::string_view label) {
  add({Kind::vertical_line,
       {{across, 1}},
       {.colour = "soft", .dashed = true, .width = 1},
       std::string(label)});
}

void Figure::label(Place at, std::string_view text) {
  add({Kind::label, {at}, {}, shortened(text)});
}

void Figure::legend(std::string_view text, const Style& style, bool line) {
  entries_.push_back({std::string(text), style, line});
}

Html Figure::svg() const {
  return Drawing(*this).svg();
}

Html figures(std::span<const TitledFigure> all) {
  Html text = markup("<div class=\"figures\">");
  for (const TitledFigure& each : all) {
    const Html title = each.title.empty() ? Html() : markup("<h4>{}</h4>", each.title);
    text += markup("<div class=\"plot\">{}{}</div>\n", title, each.svg);
  }
  return text + markup("</div>\n");
}

}  // namespace triptych::report
