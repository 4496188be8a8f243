// Sentences about values that are compared with stored values, and about correlations.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "judge/correlation/line.hpp"
#include "record/short_name.hpp"
#include "report/words/causes.hpp"
#include "report/words/finding.hpp"

namespace triptych::report::words {
namespace {

using judge::Change;
using judge::LineModel;
using judge::LineRefusal;
using judge::Observation;
using judge::Unit;

std::string label(const Change& change) {
  if (change.unit == Unit::misses) return "cache misses in generated code";
  if (change.unit == Unit::instructions) {
    const bool generated = change.name == "device_code";
    return generated ? "instructions in generated code"
                     : fmt::format("instructions in the {}", change.name);
  }
  if (change.unit == Unit::bytes) return fmt::format("bytes of {}", change.name);
  return change.name;
}

std::string list(const std::vector<Change>& changes) {
  std::string text;
  for (const Change& each : changes) {
    text += (text.empty() ? "" : "; ") + text_of(each);
  }
  return text;
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string fit(const Observation& what) {
  return fmt::format(
      "{:.0f} configurations, ln cost = {:.3f} + {:.3f} ln(cost of the other device), scatter "
      "{:.2g} %, r = {:.3f}",
      what.number("configurations"), what.number("intercept"), what.number("slope"),
      100 * std::expm1(what.number("scale")), what.number("pearson"));
}

}  // namespace

std::string text_of(const Change& change) {
  const std::string name = label(change);
  if (!change.now)
    return fmt::format("{} is missing; the stored value is {:.0f}", name, *change.before);
  if (!change.accepted.empty()) {
    std::string accepted;
    for (const auto& [device, value] : change.accepted) {
      accepted += fmt::format("{}{:.0f} on {}", accepted.empty() ? "" : ", ", value, device);
    }
    std::string text = fmt::format("{} {:.0f}, accepted {}", name, *change.now, accepted);
    if (change.allowed > 0) text += fmt::format(" (± {:.0f} for rounding)", change.allowed);
    return text;
  }
  const double before = change.before.value_or(0);
  if (before <= 0) return fmt::format("{} {:.0f} → {:.0f}", name, before, *change.now);
  return fmt::format("{} {:.0f} → {:.0f} ({})", name, before, *change.now,
                     percent(*change.now / before));
}

std::string as_stored(const Observation& what) {
  std::string text =
      what.numbers.contains("instructions")
          ? fmt::format("{:.0f} instructions, as stored", what.number("instructions"))
          : fmt::format("{} as stored", counted(what.number("values"), "value", "values"));
  if (!what.names.empty()) {
    text += fmt::format("; not compared, because they change from frame to frame: {}",
                        joined(what.names));
  }
  return text;
}

std::string values_changed(const Observation& what) {
  std::string text = list(what.changes);
  if (what.numbers.contains("instructions")) {
    text = fmt::format("instructions {:.0f} → {:.0f} ({}) in total; {}",
                       what.number("stored_instructions"), what.number("instructions"),
                       percent(what.number("instructions") / what.number("stored_instructions")),
                       text);
  }
  return text;
}

// States that the compilers differ. For each statistic of the GPU code that changed, such as the
// number of instructions, also lists its sum over all compared configurations before and after the
// change. The statistics have the names that Mesa developers use.
std::string other_compiler(const Observation& what) {
  std::string text = fmt::format(
      "not judged, because driver version {} uses a different compiler than the accepted version "
      "{}",
      what.fact("driver_version"), what.fact("other_version"));
  text += fmt::format("; the code statistics of {:.0f} of {} changed", what.number("changed"),
                      counted(what.number("configurations"), "configuration", "configurations"));
  for (const Change& each : what.changes) text += "; " + text_of(each);
  return text;
}

std::string other_driver_statistics(const Observation& what) {
  std::string text = fmt::format(
      "this driver version ({}) has no stored statistics for {}; ", what.fact("driver_version"),
      counted(what.number("configurations"), "configuration", "configurations"));
  if (what.number("stored") == 0) {
    text += "other drivers have none either";
  } else if (!what.changes.empty()) {
    constexpr std::size_t shown = 3;
    std::vector<Change> first = what.changes;
    first.resize(std::min(first.size(), shown));
    text += fmt::format(
        "in {:.0f} of them, values differ from the stored values of every driver: {}{}",
        what.number("differences"), list(first), what.changes.size() > shown ? "; …" : "");
  } else if (what.number("compared") == 0 && !what.names.empty()) {
    text += "no value can be compared with the stored values of other drivers";
  } else {
    text +=
        "the values that must be the same for all drivers match the stored values of another "
        "driver";
  }
  if (!what.names.empty()) {
    text += fmt::format("; not compared, because not all drivers count them exactly: {}",
                        joined(what.names));
  }
  return text;
}

std::string other_counter(const Observation& what) {
  const bool other_version = what.fact("driver_version") != what.fact("other_version");
  const bool other_emulator = what.fact("counted_by") != what.fact("other");
  std::string stored;
  if (other_version) stored = fmt::format("driver version {}", what.fact("other_version"));
  if (other_emulator) {
    stored += fmt::format("{}counted by {}", stored.empty() ? "" : ", ", what.fact("other"));
  }
  std::string text;
  if (what.numbers.contains("median_ratio")) {
    text = fmt::format("median change {}, largest {} in {}, over {} (stored: {}); ",
                       percent(what.number("median_ratio")), percent(what.number("worst_ratio")),
                       record::short_name(what.fact("configuration")),
                       counted(what.number("configurations"), "configuration", "configurations"),
                       stored);
    stored.clear();
  }
  text += fmt::format("not judged, because no cost is stored for driver version {}",
                      what.fact("driver_version"));
  if (other_emulator) text += fmt::format(", counted by {}", what.fact("counted_by"));
  if (!stored.empty()) text += fmt::format(" (stored: {})", stored);
  return text;
}

std::string time(const Observation& what) {
  const double ratio = what.number("ratio");
  std::string text = fmt::format("{:.4g} ms, stored {:.4g} ms: {:+.1f} % ± {:.1f} %",
                                 1e-6 * what.number("median_ns"), 1e-6 * what.number("baseline_ns"),
                                 100 * (ratio - 1), 100 * std::expm1(what.number("half_width")));
  if (what.numbers.contains("work_ratio")) {
    text += fmt::format("; work ({}) {:+.1f} %, time per unit of work {:+.1f} %", what.fact("work"),
                        100 * (what.number("work_ratio") - 1),
                        100 * (ratio / what.number("work_ratio") - 1));
  }
  if (!what.fact("kernel_hash").empty()) text += "; the device code has changed, too";
  return text;
}

std::string times(const Observation& what) {
  return fmt::format("frame times: {:+.1f} % (median of {}), at worst {:+.1f} % ± {:.1f} % in {}",
                     100 * (what.number("ratio") - 1),
                     counted(what.number("configurations"), "configuration", "configurations"),
                     100 * (what.number("worst_ratio") - 1),
                     100 * std::expm1(what.number("worst_half_width")), what.fact("configuration"));
}

std::string error(const Observation& what) {
  return fmt::format("RMSE {:.3g} against the limit image, allowed {:.3g}", what.number("rmse"),
                     what.number("bound"));
}

std::string order(const Observation& what) {
  const std::string accepted = fmt::format("accepted {:.2f} ± {:.2f}", what.number("stored_order"),
                                           what.number("stored_half_width"));
  if (what.cause == judge::Cause::no_order) {
    return "no order of convergence can be fitted, because too few errors are dominated by the "
           "step size; " +
           accepted;
  }
  return fmt::format("order of convergence {:.2f} ± {:.2f}, {}", what.number("order"),
                     what.number("half_width"), accepted);
}

std::string residual_moved(const Observation& what) {
  std::string text = fmt::format("instructions since the baseline was accepted: {}",
                                 percent(what.number("ratio")));
  const double least = what.number("least_ratio");
  const double most = what.number("largest_ratio");
  if (std::abs(std::log(most / least)) > 1e-5) {
    text += fmt::format(", {} to {}", percent(least), percent(most));
  }
  if (what.number("configurations") > 1) {
    text += fmt::format(" in {:.0f} configurations", what.number("configurations"));
  }
  return text +
         fmt::format(
             "; the cost ratios of this device to {} changed by more than their variation between "
             "runs",
             joined(what.names));
}

std::string off_the_line(const Observation& what) {
  std::string text = fmt::format(
      "{} ± {:.2g} % instructions compared with the prediction from the cost of {}, false "
      "discovery rate {:.2g}",
      percent(what.number("ratio")), 100 * std::expm1(what.number("standard_error")),
      what.fact("other"), what.number("q"));
  if (what.number("configurations") > 1) {
    text += fmt::format(" ({:.0f} configurations, relative to all other configurations)",
                        what.number("configurations"));
  }
  return text +
         "; this device was never accepted, so either it is inherently slower here, or the code "
         "regressed";
}

std::string on_the_line(const Observation& what) {
  return fmt::format("the cost of this device agrees with the prediction from the cost of {}: {}",
                     what.fact("other"), fit(what));
}

std::string no_line(const Observation& what) {
  judge::CorrelationLine line;
  line.configurations = static_cast<std::size_t>(what.number("configurations"));
  line.rho = what.number("rho");
  line.slope = what.number("slope");
  line.scale = what.number("scale");
  for (const LineRefusal each : {LineRefusal::too_few_configurations, LineRefusal::low_correlation,
                                 LineRefusal::slope_out_of_range, LineRefusal::large_scatter}) {
    if (judge::name_of(each) == what.fact("refusal")) line.refusal = each;
  }
  return fmt::format("the cost of this device cannot be correlated with the cost of {}: {}",
                     what.fact("other"), refusal(line));
}

std::string refusal(const judge::CorrelationLine& line) {
  switch (line.refusal) {
    case LineRefusal::none:
      break;
    case LineRefusal::too_few_configurations:
      return fmt::format("the devices have {} configurations in common, but {} are needed",
                         line.configurations, LineModel::least_configurations);
    case LineRefusal::low_correlation:
      return fmt::format(
          "the correlation of the logarithms of the values is {:.3f}, but at least {} is needed",
          line.rho, LineModel::least_rho);
    case LineRefusal::slope_out_of_range:
      return fmt::format("the slope of the fitted line is {:.3f}, outside the range {} to {}",
                         line.slope, LineModel::least_slope, LineModel::largest_slope);
    case LineRefusal::large_scatter:
      return fmt::format(
          "the scatter of the logarithms of the values is {:.3f}, but at most {} is allowed",
          line.scale, LineModel::largest_scale);
  }
  return {};
}

}  // namespace triptych::report::words
