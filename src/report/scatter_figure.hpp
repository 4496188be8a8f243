#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/html.hpp"

namespace triptych::report {

// Two devices' values of the same configurations against each other.
struct ScatterFigure {
  struct Point {
    std::string name;       // of the configuration
    std::string technique;  // gives the colour
    double across, up;
    double deviation = 0;   // from the line, as a share: 0.1 is a tenth more
    std::string flag = {};  // "slower", …: drawn as a cross and named; empty: as expected
  };
  struct Line {
    double intercept, slope;  // of natural logarithms: ln up = intercept + slope · ln across
  };
  std::string across;  // titles of the axes, unit included
  std::string up;
  std::vector<Point> points;
  std::optional<Line> line = {};
  std::optional<double> shows_from = {};  // the deviation from which one point alone would show
};

// HTML: both values on logarithmic axes with the line, and beside it what is left beyond the line,
// flagged points with their deviation. Without a line the first alone.
[[nodiscard]] Html scatter_chart(const ScatterFigure& scatter);

}  // namespace triptych::report
