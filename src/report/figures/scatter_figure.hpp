#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/html.hpp"

namespace triptych::report {

// The costs or times of two devices for the same configurations.
struct ScatterFigure {
  struct Point {
    std::string name;       // the name of the configuration
    std::string technique;  // determines the colour
    double across, up;
    double deviation = 0;   // relative deviation from the fitted line: 0.1 is 10 % more
    std::string flag = {};  // "more" or "less": drawn as a labelled cross; empty: not flagged
  };
  struct Line {
    double intercept, slope;  // the fitted line: ln up = intercept + slope · ln across
  };
  std::string across;  // titles of the axes, including the unit
  std::string up;
  std::vector<Point> points;
  std::optional<Line> line = {};
  // The smallest deviation at which a single configuration is reported; drawn as a dashed line.
  std::optional<double> reporting_threshold = {};
};

// Returns two figures: one shows both values on logarithmic axes, with the fitted line; the other
// shows the deviations from this line. Flagged points have labels. Without a line, returns only the
// first figure.
[[nodiscard]] Html scatter_chart(const ScatterFigure& scatter);

}  // namespace triptych::report
