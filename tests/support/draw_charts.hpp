#pragma once
// Draws the charts of a page as a browser would, without one: Vega and Vega-Lite as they are
// bundled, run by Node.js. Needs TRIPTYCH_DRAW_CHARTS, which cmake/charts.cmake defines.

#include <filesystem>
#include <string>
#include <utility>

#include "support/command.hpp"

namespace triptych::test {

struct DrawnCharts {
  bool all = false;  // each draws something, without a warning
  std::string text;  // "page.html #plan0-times: 96 marks", a line each
};

inline DrawnCharts draw_charts(const std::filesystem::path& page) {
  Result drawn = run_command(TRIPTYCH_DRAW_CHARTS " '" + page.string() + "'");
  return {.all = drawn.code == 0, .text = std::move(drawn.output)};
}

}  // namespace triptych::test
