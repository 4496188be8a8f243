#pragma once
// Draws the charts of a page as a browser would, without one: Vega and Vega-Lite as they are
// bundled, run by Node.js. Needs TRIPTYCH_DRAW_CHARTS, which cmake/charts.cmake defines.

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace triptych::test {

struct DrawnCharts {
  bool all = false;  // each draws something, without a warning
  std::string text;  // "page.html #plan0-times: 96 marks", a line each
};

inline DrawnCharts draw_charts(const std::filesystem::path& page) {
  const std::string command = TRIPTYCH_DRAW_CHARTS " '" + page.string() + "' 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start " + command);
  DrawnCharts result;
  std::array<char, 4096> bytes{};
  while (const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), pipe)) {
    result.text.append(bytes.data(), got);
  }
  const int status = ::pclose(pipe);
  result.all = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return result;
}

}  // namespace triptych::test
