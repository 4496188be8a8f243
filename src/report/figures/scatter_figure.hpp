#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/html.hpp"

namespace triptych::report {

// The values of two devices for the same configurations.
struct ScatterFigure {
  struct Point {
    std::string name;       // the name of the configuration
    std::string technique;  // determines the colour
    double across, up;
    double deviation = 0;   // deviation from the line, as a share: 0.1 is 10 % more
    std::string flag = {};  // "more" or "less": drawn as a cross with its name; empty: as expected
  };
  struct Line {
    double intercept, slope;  // of natural logarithms: ln up = intercept + slope · ln across
  };
  std::string across;  // titles of the axes, including the unit
  std::string up;
  std::vector<Point> points;
  std::optional<Line> line = {};
  std::optional<double> shows_from = {};  // dashed lines: a single outlier is found from here on
};

// HTML: both values on logarithmic axes with the line, and next to it the deviations from the line,
// with labels for flagged points. Without a line, only the first part.
[[nodiscard]] Html scatter_chart(const ScatterFigure& scatter);

}  // namespace triptych::report
