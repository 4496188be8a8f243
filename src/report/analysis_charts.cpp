#include "report/analysis_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "record/record.hpp"
#include "report/figure.hpp"

namespace triptych::report {
namespace {

using core::Json;

// Not a number for null, which a figure leaves out.
double number(const Json& row, const char* name) {
  const Json& cell = row.at(name);
  return cell.is_number() ? cell.get<double>() : std::nan("");
}

std::string text(const Json& row, const char* name) {
  const Json& cell = row.at(name);
  return cell.is_string() ? cell.get<std::string>() : cell.dump();
}

std::size_t index_in(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) names.push_back(name);
  return static_cast<std::size_t>(found - names.begin());
}

// Levels in the order in which they are met, which is their natural one.
struct Cell {
  std::string column, row;
  double value;
  std::string tooltip;
};

// Cells coloured by how far up they lie between the least and the largest, their number in them.
std::string heat_map(const std::string& description, const std::vector<Cell>& cells, double low,
                     double high, bool logarithmic, int decimals) {
  Axis across;
  Axis up;
  for (const Cell& cell : cells) {
    index_in(across.names, cell.column);
    index_in(up.names, cell.row);
  }
  const double columns = static_cast<double>(across.names.size());
  Figure figure(description, across, up, 56 * columns, 24 * static_cast<double>(up.names.size()));
  for (const Cell& cell : cells) {
    if (!std::isfinite(cell.value)) continue;
    const auto x = static_cast<double>(index_in(across.names, cell.column));
    const auto y = static_cast<double>(index_in(up.names, cell.row));
    const double share = logarithmic ? std::log(cell.value / low) / std::log(high / low)
                                     : (cell.value - low) / (high - low);
    const double shade = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.5;
    figure.box({x - 0.48, y - 0.46}, {x + 0.48, y + 0.46},
               {.colour = "c0", .opacity = 0.06 + 0.5 * shade}, cell.tooltip);
    figure.number({x, y}, decimals < 0 ? short_number(std::stod(fmt::format("{:.3g}", cell.value)))
                                       : fmt::format("{:.{}f}", cell.value, decimals));
  }
  return figure.empty() ? std::string() : figure.svg();
}

}  // namespace

std::string histogram_chart(const Json& bins, bool logarithmic) {
  Figure figure("Histogram of times with the fit's expectation",
                {.title = "time of a frame, ms", .logarithmic = logarithmic},
                {.title = "configurations"}, 400, 200);
  std::vector<Figure::Place> curve;
  for (const Json& bin : bins) {
    const double from = number(bin, "from_ms");
    const double to = number(bin, "to_ms");
    figure.box({from, 0}, {to, number(bin, "count")}, {.colour = "c0", .opacity = 0.6},
               fmt::format("{:.3g} to {:.3g} ms: {}, expected {:.3g}", from, to, text(bin, "count"),
                           number(bin, "expected")));
    // The fit belongs to the middle of a bin, on the bins' own scale.
    curve.push_back(
        {logarithmic ? std::sqrt(from * to) : (from + to) / 2, number(bin, "expected")});
  }
  figure.line(curve, {.colour = "ink", .width = 1.5}, "log-normal fit");
  return figure.empty() ? std::string() : figure.svg();
}

std::string correlation_boxes_chart(const Json& cells) {
  Axis up;
  std::map<std::size_t, std::vector<double>> of_factor;
  for (const Json& each : cells) {
    const double r = number(each, "r");
    if (std::isfinite(r)) of_factor[index_in(up.names, text(each, "factor"))].push_back(r);
  }
  Figure figure("Pearson's r of all pairs of levels, by factor", {.title = "Pearson's r"}, up, 460,
                24 * static_cast<double>(std::max<std::size_t>(up.names.size(), 1)));
  for (const auto& [index, all] : of_factor) {
    const auto row = static_cast<double>(index);
    const record::Summary summary = *record::summarise(all);
    if (all.size() >= 3) {  // of fewer a box says nothing that the strokes do not
      figure.box(
          {summary.lower_quartile, row - 0.3}, {summary.upper_quartile, row + 0.3},
          {.colour = "c0", .opacity = 0.4},
          fmt::format("{}: median {:.3f} of {}", up.names[index], summary.median, all.size()));
    }
    figure.strokes(all, row, 0.3, {.colour = "ink", .opacity = 0.8, .width = 1});
  }
  return figure.empty() ? std::string() : figure.svg();
}

std::string correlation_matrix_chart(const Json& cells) {
  std::vector<Cell> both;
  for (const Json& each : cells) {
    const std::string a = text(each, "a");
    const std::string b = text(each, "b");
    const double r = number(each, "r");
    const std::string tooltip =
        fmt::format("{} and {}: r {:.3f} of {} pairs", a, b, r, text(each, "pairs"));
    both.push_back({a, b, r, tooltip});
    both.push_back({b, a, r, tooltip});
  }
  // Both axes in one order: the first level, then those that it is paired with.
  std::vector<std::string> order;
  for (const Json& each : cells) {
    index_in(order, text(each, "a"));
    index_in(order, text(each, "b"));
  }
  std::ranges::stable_sort(both, {}, [&](const Cell& cell) {
    return std::pair(index_in(order, cell.row), index_in(order, cell.column));
  });
  if (!both.empty()) {
    both.insert(both.begin(), {order.front(), order.front(), std::nan(""), ""});
  }
  return heat_map("Pearson's r between levels", both, 0, 1, false, 2);
}

std::string mean_times_chart(const Json& cells) {
  std::vector<Cell> all;
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  for (const Json& each : cells) {
    const double ms = number(each, "mean_ms");
    if (ms > 0) {
      low = std::min(low, ms);
      high = std::max(high, ms);
    }
    all.push_back({text(each, "column"), text(each, "row"), ms,
                   fmt::format("{}, {}: {:.4g} ms, {} samples", text(each, "row"),
                               text(each, "column"), ms, text(each, "samples"))});
  }
  return heat_map("Mean times, ms", all, low, high, true, -1);
}

std::string speed_ups_chart(const Json& rows) {
  Axis up;
  for (const Json& row : rows) index_in(up.names, text(row, "level"));
  Figure figure("Speed-ups by level", {.title = "speed-up"}, up, 400,
                24 * static_cast<double>(std::max<std::size_t>(up.names.size(), 1)));
  for (const Json& row : rows) {
    const auto y = static_cast<double>(index_in(up.names, text(row, "level")));
    figure.box({0, y - 0.35}, {number(row, "speed_up"), y + 0.35}, {.colour = "c0", .opacity = 0.6},
               fmt::format("{} against {}: {:.3g} ± {:.2g}, r {:.3f}", text(row, "level"),
                           text(row, "reference"), number(row, "speed_up"), number(row, "error"),
                           number(row, "r")));
    figure.line(
        std::array{Figure::Place{number(row, "low"), y}, Figure::Place{number(row, "high"), y}},
        {.colour = "ink", .width = 2});
  }
  return figure.empty() ? std::string() : figure.svg();
}

}  // namespace triptych::report
