#include "report/figures/scatter_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "report/figures/figure.hpp"

namespace triptych::report {
namespace {

constexpr double side = 300;

std::string whole_percent(double share) {
  return fmt::format("{:+.0f} %", 100 * share);
}

class ScatterDrawing {
 public:
  explicit ScatterDrawing(const ScatterFigure& scatter) : scatter_(scatter) {
    std::set<std::string> names;
    for (const auto& point : scatter.points) names.insert(point.technique);
    techniques_.assign(names.begin(), names.end());
  }

  [[nodiscard]] Html values() const {
    Figure figure(fmt::format("{} against {}, {} configurations", scatter_.up, scatter_.across,
                              scatter_.points.size()),
                  {.title = scatter_.across, .logarithmic = true},
                  {.title = scatter_.up, .logarithmic = true}, side, side);
    add_line(figure);
    for (const auto& point : scatter_.points) {
      figure.series(point.technique.empty() ? "configurations" : point.technique);
      figure.point({point.across, point.up}, style_of(point), tooltip(point));
    }
    add_legend(figure);
    return figure.svg();
  }

  [[nodiscard]] Html deviations() const {
    double largest = std::max(0.01, scatter_.reporting_threshold.value_or(0));
    for (const auto& point : scatter_.points) {
      largest = std::max(largest, std::abs(point.deviation));
    }
    Figure figure("Deviations from the fitted line",
                  {.title = scatter_.across, .logarithmic = true},
                  {.title = "deviation from the fitted line",
                   .percent = true,
                   .low = -1.1 * largest,
                   .high = 1.1 * largest},
                  side, side);
    add_horizontal_line(figure, 0, {.colour = "soft"});
    if (scatter_.reporting_threshold) {
      add_horizontal_line(figure, *scatter_.reporting_threshold,
                          {.colour = "soft", .dashed = true});
      figure.label({x_range().first, *scatter_.reporting_threshold}, "reporting threshold");
    }
    for (const auto& point : scatter_.points) {
      figure.series(point.technique.empty() ? "configurations" : point.technique);
      figure.point({point.across, point.deviation}, style_of(point), tooltip(point));
      if (!point.flag.empty())
        figure.label({point.across, point.deviation}, whole_percent(point.deviation));
    }
    add_legend(figure);
    return figure.svg();
  }

 private:
  [[nodiscard]] Style style_of(const ScatterFigure::Point& point) const {
    const auto technique = std::ranges::find(techniques_, point.technique) - techniques_.begin();
    return {.colour = colour_of(static_cast<std::size_t>(technique)),
            .mark = point.flag.empty() ? Mark::circle : Mark::cross,
            .opacity = 0.8};
  }
  static std::string tooltip(const ScatterFigure::Point& point) {
    const std::string flag = point.flag.empty() ? "" : ", " + point.flag;
    return fmt::format("{}: {:.4g} against {:.4g}, {:+.1f} %{}", point.name, point.up, point.across,
                       100 * point.deviation, flag);
  }
  [[nodiscard]] std::pair<double, double> x_range() const {
    const auto [first, last] =
        std::ranges::minmax_element(scatter_.points, {}, &ScatterFigure::Point::across);
    return {first->across, last->across};
  }
  void add_horizontal_line(Figure& figure, double deviation, const Style& style) const {
    const auto [first, last] = x_range();
    figure.line(std::array{Figure::Place{first, deviation}, Figure::Place{last, deviation}}, style);
  }
  // Two points are enough, because the fitted line is straight on logarithmic axes.
  void add_line(Figure& figure) const {
    if (!scatter_.line) return;
    const auto at = [&](double x) {
      return Figure::Place{x,
                           std::exp(scatter_.line->intercept + scatter_.line->slope * std::log(x))};
    };
    const auto [first, last] = x_range();
    figure.line(std::array{at(first), at(last)}, {.colour = "soft"}, "the fitted line");
  }
  void add_legend(Figure& figure) const {
    for (std::size_t i = 0; i < techniques_.size(); ++i) {
      figure.legend(techniques_[i], {.colour = colour_of(i)});
    }
    if (std::ranges::any_of(scatter_.points, [](const auto& each) { return !each.flag.empty(); })) {
      figure.legend("off the fitted line", {.colour = "ink", .mark = Mark::cross});
    }
  }

  const ScatterFigure& scatter_;
  std::vector<std::string> techniques_;
};

}  // namespace

Html scatter_chart(const ScatterFigure& scatter) {
  if (scatter.points.empty()) return {};
  const ScatterDrawing drawing(scatter);
  std::vector<TitledFigure> all{{"", drawing.values()}};
  if (scatter.line) all.push_back({"", drawing.deviations()});
  return figures(all);
}

}  // namespace triptych::report
