// Shows how closely the costs of two devices are related: for each pair of devices, a scatter plot
// with the fitted line, and the configurations that are off the line.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures/scatter_figure.hpp"
#include "report/html.hpp"
#include "report/page/page_frame.hpp"
#include "report/page/page_sections.hpp"
#include "report/words/finding.hpp"

namespace triptych::report {
namespace {

using judge::CorrelationPair;

// Returns the technique in a configuration key: "…,technique=raycast,…" → "raycast".
std::string technique_in(const std::string& configuration) {
  constexpr std::string_view name = "technique=";
  const std::size_t at = configuration.find(name);
  if (at == std::string::npos) return {};
  return configuration.substr(at + name.size(), configuration.find(',', at) - at - name.size());
}

Html fit_text(const CorrelationPair& pair) {
  const judge::CorrelationLine& line = pair.line;
  if (!std::isfinite(line.slope)) return markup("<p>{}.</p>\n", words::refusal(line));
  return markup(
      "<p>{} configurations. The line is ln y = {:.3f} + {:.3f} ln x, where x is the number of {} "
      "per frame on {}, and y is this number on {}. The points scatter about the line by {:.2g} %. "
      "Pearson’s r is {:.4f} for x and y, and {:.4f} for their logarithms. {}</p>\n",
      line.configurations, line.intercept, line.slope,
      pair.signal == "cost" ? "instructions" : "nanoseconds", pair.device_a, pair.device_b,
      100 * std::expm1(line.scale), line.pearson, line.rho,
      line.admitted()
          ? Html()
          : markup("<b class=\"cannot_judge\">Not judged</b>: {}", words::refusal(line)));
}

// Converts a pair to a figure. The logarithms in the pair are converted to millions of instructions
// or to milliseconds.
ScatterFigure scatter_of(const CorrelationPair& pair) {
  const bool cost = pair.signal == "cost";
  const double unit = std::log(1e-6);  // instructions in millions, nanoseconds in milliseconds
  const std::string_view unit_name = cost ? "M instructions" : "ms";
  ScatterFigure scatter{.across = fmt::format("{}, {}", pair.device_a, unit_name),
                        .up = fmt::format("{}, {}", pair.device_b, unit_name),
                        .points = {}};
  for (const judge::CorrelationPoint& point : pair.points) {
    scatter.points.push_back(
        {.name = point.configuration,
         .technique = technique_in(point.configuration),
         .across = std::exp(point.x + unit),
         .up = std::exp(point.y + unit),
         .deviation = std::isfinite(point.residual) ? std::expm1(point.residual) : 0,
         .flag = !point.outlier       ? ""
                 : point.residual < 0 ? "less"
                                      : "more"});
  }
  if (std::isfinite(pair.line.slope)) {
    scatter.line = {pair.line.intercept + unit - pair.line.slope * unit, pair.line.slope};
  }
  return scatter;
}

Html pair_part(const CorrelationPair& pair) {
  return markup("<h4>{} against {}, by {}{}</h4>", pair.device_b, pair.device_a, pair.signal,
                pair.new_device ? " (this device was never accepted)" : "") +
         scatter_chart(scatter_of(pair)) + fit_text(pair);
}

}  // namespace

Html correlation_section(const PlanData& plan) {
  Html judged;
  Html shown;
  for (const CorrelationPair& pair : plan.verdict->correlations) {
    if (pair.points.empty()) continue;
    const bool marked = std::ranges::any_of(pair.points, &judge::CorrelationPoint::outlier);
    (pair.signal == "cost" && (marked || judged.empty()) ? judged : shown) += pair_part(pair);
  }
  if (judged.empty() && shown.empty()) return {};
  Html text = markup(
                  "<h3>Comparison of the costs on different devices</h3><p>Each point is a "
                  "configuration. The horizontal axis is its cost on one device, and the vertical "
                  "axis is its cost on another device. The second figure shows the deviation of "
                  "each point from the line that is fitted to the points.</p>") +
              judged;
  return text + folded("Other pairs of devices", shown);
}

}  // namespace triptych::report
