// How the run's devices keep step with others: a scatter plot per pair, the line, what stands out.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "judge/gate/correlation_pairs.hpp"
#include "report/html.hpp"
#include "report/page_frame.hpp"
#include "report/page_sections.hpp"
#include "report/scatter_figure.hpp"

namespace triptych::report {
namespace {

using Rows = std::vector<std::vector<std::string>>;
using judge::CorrelationPair;

constexpr std::size_t shown_levels = 12;

std::string percent(double effect) {
  return fmt::format("{:+.1f} %", 100 * std::expm1(effect));
}

std::string p_value(double p) {
  return fmt::format("{:.2g}", p);
}

std::string fit_table(const CorrelationPair& pair) {
  const judge::Correlation& result = pair.result;
  Rows rows{{"configurations", "anchors", "Pearson’s r of times", "of ln t", "α", "β", "residuals",
             "one configuration shows from"}};
  rows.push_back({fmt::format("{}", result.configurations), fmt::format("{}", result.anchors),
                  fmt::format("{:.4f}", result.r), fmt::format("{:.4f}", result.rho),
                  fmt::format("{:.3f} ± {:.3f}", result.line.intercept, result.intercept_error),
                  fmt::format("{:.3f} ± {:.3f}", result.line.slope, result.slope_error),
                  percent(result.scale), result.admitted() ? percent(result.smallest_effect) : ""});
  return table(rows);
}

std::string admission(const CorrelationPair& pair) {
  if (pair.result.admitted()) {
    const std::string beside =
        pair.result.line_beside.empty()
            ? ""
            : fmt::format(" The line is beside an offset of {}.", escape(pair.result.line_beside));
    std::string_view role = "<b class=\"pass\">Admitted</b>: this baseline judges the device.";
    if (!pair.decides) {
      role =
          "<b class=\"pass\">Admitted</b>, but another stored device correlates better and "
          "decides.";
    }
    if (pair.within_run) role = "The two are alike enough that one could judge the other.";
    return fmt::format("<p>{}{}</p>", role, beside);
  }
  std::string text = fmt::format("<p><b class=\"cannot_judge\">Refused</b>: {}",
                                 escape(fmt::format("{}", fmt::join(pair.result.refusals, "; "))));
  if (pair.unlike_clocks + pair.unlike_anchors > 0) {
    text += fmt::format("; {} configurations and {} anchors were timed by other kinds of clocks",
                        pair.unlike_clocks, pair.unlike_anchors);
  }
  return text + ".</p>";
}

std::string work_text(const judge::CorrelationCase& each, double residual) {
  if (!each.work) return "";
  return fmt::format("{} {}, time per unit {}", escape(each.work->unit),
                     percent(each.work->log_ratio), percent(residual - each.work->log_ratio));
}

std::string outlier_table(const CorrelationPair& pair) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < pair.cases.size(); ++i) {
    const auto& judgement = pair.result.judgements[i];
    if (judgement.slower || judgement.faster) order.push_back(i);
  }
  if (order.empty()) return {};
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t i) { return pair.result.judgements[i].residual; });
  Rows rows{
      {"configuration", "time", "deviation", "z", "q", "share of all deviation", "more work?", ""}};
  for (const std::size_t i : order) {
    const auto& each = pair.cases[i];
    const auto& judgement = pair.result.judgements[i];
    rows.push_back({escape(each.configuration), duration(std::exp(each.log_time_b)),
                    percent(judgement.residual), fmt::format("{:.1f}", judgement.z),
                    judgement.slower ? p_value(judgement.q) : "",
                    fmt::format("{:.0f} %", 100 * judgement.share),
                    work_text(each, judgement.residual),
                    judgement.standing ? "as when accepted" : ""});
  }
  return "<h5>Off the line</h5>" + table(rows);
}

std::string level_table(const CorrelationPair& pair) {
  if (pair.result.levels.empty()) return {};
  Rows rows{{"factor level", "configurations", "against the others", "standard error", "q",
             "share of all deviation", "would have shown from", ""}};
  for (const judge::LevelEffect& level : pair.result.levels) {
    if (rows.size() > shown_levels) break;
    std::string name = fmt::format("{}={}", level.factor, level.level);
    for (const std::string& alias : level.aliases) name += ", " + alias;
    rows.push_back({escape(name), fmt::format("{}", level.size), percent(level.effect),
                    fmt::format("{:.1f} %", 100 * level.standard_error), p_value(level.q),
                    fmt::format("{:.0f} %", 100 * level.share), percent(level.smallest_effect),
                    level.standing ? "as when accepted"
                    : level.slower ? "<b class=\"regression\">slower</b>"
                                   : ""});
  }
  return "<h5>Factor levels</h5>" + table(rows);
}

std::string global_text(const CorrelationPair& pair) {
  const judge::GlobalShift& global = pair.result.global;
  if (global.groups < 2 || !pair.result.admitted()) return {};
  const std::string what =
      global.since_acceptance
          ? fmt::format(
                "changed by {} ± {:.1f} % since the device was accepted (the lower quartile of its "
                "configurations), beside {} anchors",
                percent(global.delta), 100 * std::expm1(global.standard_error), global.groups)
          : fmt::format("lies {} ± {:.1f} % from the line of {} groups of anchors",
                        percent(global.delta), 100 * std::expm1(global.standard_error),
                        global.groups);
  return fmt::format(
      "<p>The program as a whole {} (p = {}); a slowdown of everything would have shown from {} "
      "on.</p>",
      what, p_value(global.p), percent(global.smallest_effect));
}

// The one place that knows how a pair is kept.
ScatterFigure scatter_of(const CorrelationPair& pair) {
  const auto milliseconds = [](double log_ns) { return 1e-6 * std::exp(log_ns); };
  ScatterFigure scatter{.across = (pair.of_itself ? "its stored runs" : pair.other) + ", ms",
                        .up = pair.device + ", ms",
                        .points = {}};
  for (std::size_t i = 0; i < pair.cases.size(); ++i) {
    const judge::CorrelationCase& each = pair.cases[i];
    const judge::ConfigurationJudgement& judgement = pair.result.judgements[i];
    if (each.anchor) continue;
    scatter.points.push_back({.name = each.configuration,
                              .technique = each.factors.at("technique"),
                              .across = milliseconds(each.log_time_a),
                              .up = milliseconds(each.log_time_b),
                              .deviation = std::expm1(judgement.residual),
                              .flag = judgement.slower   ? "slower"
                                      : judgement.faster ? "faster"
                                                         : ""});
  }
  if (pair.result.line.slope != 0) {
    // ln ms from ln ns on both axes
    const double unit = std::log(1e-6);
    scatter.line = {pair.result.line.intercept + unit - pair.result.line.slope * unit,
                    pair.result.line.slope};
    if (pair.result.admitted()) scatter.shows_from = std::expm1(pair.result.smallest_effect);
  }
  return scatter;
}

std::string pair_part(const CorrelationPair& pair) {
  std::string text =
      fmt::format("<h4>{} against {}{}</h4><p class=\"system\">{}</p>", escape(pair.device),
                  pair.of_itself ? "its own history" : escape(pair.other),
                  pair.within_run ? ", of the same run" : "", escape(pair.other_key));
  text += admission(pair);
  if (pair.cases.empty()) return text;
  text += scatter_chart(scatter_of(pair));
  return text + fit_table(pair) + global_text(pair) + outlier_table(pair) + level_table(pair);
}

}  // namespace

std::string correlation_section(const PlanData& plan) {
  std::string stored;
  std::string farther;
  std::string consistency;
  const std::set<std::string> decided = judge::decided_devices(plan.verdict->correlations);
  for (const CorrelationPair& pair : plan.verdict->correlations) {
    const bool aside = judge::is_beside_what_decides(pair, decided);
    (pair.within_run ? consistency : aside ? farther : stored) += pair_part(pair);
  }
  if (plan.verdict->correlations.empty()) return {};
  std::string text =
      "<h3>Other devices</h3><p>Each point is a configuration: its time on another device across, "
      "on this one upwards. Beside it what is left of each beyond the line; above the dashed rule "
      "one configuration alone would show.</p>" +
      stored;
  if (!farther.empty()) {
    text += fmt::format(
        "<details><summary>What stored devices that do not decide say</summary>{}</details>\n",
        farther);
  }
  if (!consistency.empty()) {
    text += fmt::format(
        "<details><summary>The devices of this run among each other: shown, not "
        "judged</summary>{}</details>\n",
        consistency);
  }
  return text;
}

}  // namespace triptych::report
