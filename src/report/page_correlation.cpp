// How the run's devices keep step with others: a scatter plot per pair and its line.

#include <fmt/format.h>

#include <cmath>

#include "report/correlation_chart.hpp"
#include "report/html.hpp"
#include "report/page_frame.hpp"
#include "report/page_sections.hpp"

namespace triptych::report {
namespace {

using judge::CorrelationPair;

std::string line_table(const judge::CorrelationLine& line) {
  return table(
      {{"configurations", "Pearson’s r", "of logarithms", "α", "β", "residuals"},
       {fmt::format("{}", line.configurations), fmt::format("{:.4f}", line.pearson),
        fmt::format("{:.4f}", line.rho), fmt::format("{:.3f}", line.intercept),
        fmt::format("{:.3f}", line.slope), fmt::format("{:.1f} %", 100 * std::expm1(line.scale))}});
}

std::string pair_part(const PlanData& plan, const CorrelationPair& pair, std::size_t index) {
  std::string text = fmt::format("<h4>{} of {} against {}</h4>", pair.signal, escape(pair.device_b),
                                 escape(pair.device_a));
  if (!pair.line.admitted()) text += fmt::format("<p>{}.</p>", escape(pair.line.refusal));
  if (pair.points.empty()) return text;
  text += chart(fmt::format("{}-correlation{}", plan.anchor, index), correlation_chart(pair));
  return text + line_table(pair.line);
}

}  // namespace

std::string correlation_section(const PlanData& plan) {
  std::string text;
  std::size_t index = 0;
  for (const CorrelationPair& pair : plan.verdict->correlations) {
    text += pair_part(plan, pair, index++);
  }
  if (index == 0) return {};
  return "<h3>Other devices</h3><p>Each point is a configuration: on one device across, on the "
         "other upwards.</p>" +
         text;
}

}  // namespace triptych::report
