#include <fmt/format.h>

#include <cmath>

#include "report/csv.hpp"
#include "report/figures/figure.hpp"

namespace triptych::report {
namespace {

Cell cell_of(const Axis& axis, double value) {
  if (axis.names.empty()) return value;
  return axis.names.at(static_cast<std::size_t>(std::lround(value)));
}

std::string or_else(const std::string& title, const char* name) {
  return title.empty() ? name : title;
}

std::string row_of(const Cell& series, const Cell& across, const Cell& up, const Cell& label) {
  return fmt::format("{},{},{},{}\n", csv_field(series), csv_field(across), csv_field(up),
                     csv_field(label));
}

}  // namespace

std::string Figure::csv() const {
  std::string rows;
  for (const Shape& shape : shapes_) {
    if (shape.series.empty() || (shape.kind != Kind::point && shape.kind != Kind::strokes))
      continue;
    for (const Place& place : shape.places) {
      rows +=
          row_of(shape.series, cell_of(x_axis_, place.x), cell_of(y_axis_, place.y), shape.text);
    }
  }
  if (rows.empty()) return {};
  const std::string head = row_of(std::string("series"), or_else(x_axis_.title, "x"),
                                  or_else(y_axis_.title, "y"), std::string("label"));
  return head + rows;
}

}  // namespace triptych::report
