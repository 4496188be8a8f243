#include "report/screen/comparison_screen.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "report/words/comparison.hpp"

namespace triptych::report {
namespace {

using comparison::ComparedConfiguration;
using comparison::ComparisonResult;
using comparison::DeviceChange;
using comparison::DifferenceKind;
using comparison::HistoryPoint;

std::string_view name_of(measure::SideClock clock) {
  return clock == measure::SideClock::device ? "device" : "wall";
}

// Formats the time ratio of b to a and its confidence interval as "1.0520 [1.0470, 1.0580]".
std::string ratio_of(const comparison::Shift& shift) {
  return fmt::format("{:.4f} [{:.4f}, {:.4f}]", std::exp(shift.estimate),
                     std::exp(shift.interval.low), std::exp(shift.interval.high));
}

// Formats the times of both sides as "1.23 ms (1.20 to 1.26) → 1.31 ms (1.28 to 1.35)": the median,
// and the quartiles in parentheses.
std::string milliseconds_of(const ComparedConfiguration& compared) {
  if (!compared.times) return {};
  const auto side = [](const comparison::SideTime& time) {
    return fmt::format("{:.3g} ms ({:.3g} to {:.3g})", time.median / 1e6, time.lower_quartile / 1e6,
                       time.upper_quartile / 1e6);
  };
  return fmt::format("{} → {}  ", side((*compared.times)[0]), side((*compared.times)[1]));
}

// Formats a change in the amount of work as "+1.20 % samples, +0.31 % time per unit of work". The
// second part is missing if there is no time. Returns "" if the work is the same.
std::string work_of(const ComparedConfiguration& compared) {
  const auto& work = compared.work;
  if (!work || work->log_ratio == 0) return {};
  const auto percent = [](double ln) { return fmt::format("{:+.2f} %", 100 * std::expm1(ln)); };
  std::string text = fmt::format("{} {}", percent(work->log_ratio), work->unit);
  if (compared.has_time()) {
    text += fmt::format(", {} time per unit of work",
                        percent(compared.shift.estimate - work->log_ratio));
  }
  return text;
}

std::string line_of(const ComparedConfiguration& compared, const ComparisonCommand& command) {
  std::string line = fmt::format("{:<12}", compared.verdict_name());
  if (compared.has_time()) {
    line += milliseconds_of(compared) +
            fmt::format("{}  {} measurement blocks", ratio_of(compared.shift), compared.blocks);
    if (compared.process_runs > 0) {
      line += fmt::format(" and {} repetitions in new processes", compared.process_runs);
    }
    line += fmt::format(", {} clock", name_of(compared.clock));
  }
  line += fmt::format("  {:.1f} s  {}", compared.seconds, compared.key);
  constexpr const char* indented = "\n              ";
  if (!compared.reason.empty()) line += indented + words::text_of(compared.reason);
  if (compared.has_time() && compared.verdict == comparison::PairVerdict::undecided) {
    line += "; to reach a verdict, run: " + command_for(compared, command);
  }
  if (const std::string work = work_of(compared); !work.empty()) line += indented + work;
  return line + "\n";
}

std::string differences_of(const ComparisonResult& result) {
  const auto groups = result.groups();
  if (!groups.empty()) return words::lines_of(groups);
  const auto& all = result.configurations;
  if (std::ranges::all_of(
          all, [](const ComparedConfiguration& each) { return each.ended.has_value(); })) {
    return words::nothing_compared(all.empty() ? comparison::TimeReason{} : all.front().reason) +
           "\n";
  }
  const bool timed =
      std::ranges::any_of(all, [](const ComparedConfiguration& each) { return each.blocks > 0; });
  return timed ? "no differences except in time\n" : "no differences\n";
}

std::string clocks_of(const ComparisonResult& result) {
  std::map<comparison::WallClockCause, int> causes;
  for (const ComparedConfiguration& compared : result.configurations)
    ++causes[compared.wall_clock_cause];
  causes.erase(comparison::WallClockCause::none);
  std::string text;
  for (const auto& [cause, count] : causes) {
    text += fmt::format("the wall clock was used in {} configurations, because {}\n", count,
                        words::text_of(cause));
  }
  return text;
}

// Returns the line for a device without differences. It states either that both sides agree or that
// nothing was measured.
std::string no_difference(const DeviceChange& change) {
  if (comparison::was_measured(change)) return "no differences\n";
  return words::nothing_compared(change.configurations.empty()
                                     ? comparison::TimeReason{}
                                     : change.configurations.front().no_time) +
         "\n";
}

std::string lines_of(const DeviceChange& change) {
  const auto groups = groups_of(change);
  const auto version = [](const record::Device& device) {
    return fmt::format("{}, API {}", device.driver_version, device.api_version);
  };
  return fmt::format("{}, {} configurations\na: {}\nb: {}\n{}\n", change.a.id,
                     change.configurations.size(), version(change.a), version(change.b),
                     groups.empty() ? no_difference(change) : words::lines_of(groups));
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "–";
}

// Returns the injected faults of a point, so that nobody blames the driver for them.
std::string injected_text(const HistoryPoint& point) {
  if (point.injected.empty()) return {};
  return fmt::format(" [injected: {}]", fmt::join(point.injected, ", "));
}

}  // namespace

std::string screen_of(const ComparisonResult& result, const ComparisonCommand& command) {
  std::string text =
      command.plan + "\n" + words::sides(result.a, result.b) + differences_of(result);
  if (result.timed) {
    text += "time of b divided by time of a, with the confidence interval in brackets:\n";
    for (const ComparedConfiguration& compared : result.configurations)
      text += line_of(compared, command);
    text += clocks_of(result);
  }
  return text + words::headline(result) + "\n";
}

std::string screen_of(const comparison::StoreDiff& diff) {
  std::string text;
  for (const DeviceChange& change : diff.devices) text += lines_of(change);
  for (const comparison::OneSidedEntry& each : diff.one_sided) {
    text += fmt::format("{:<12}  {}\n", comparison::name_of(DifferenceKind::unjudged),
                        words::text_of(each));
  }
  return text;
}

std::string screen_of(const std::vector<comparison::DeviceHistory>& history) {
  const auto names = names_of(history);
  std::string text;
  for (const comparison::DeviceHistory& device : history) {
    text += fmt::format(
        "{} (cost and time are relative to the first store)\n  {:<28} {:<20} {:>9} {:>9}  driver\n",
        device.device, "store", "started", "cost", "time");
    for (const HistoryPoint& point : device.points) {
      text += fmt::format("  {:<28} {:<20} {:>9} {:>9}  {}\n", names.at(point.store),
                          point.started_at, number(point.cost), number(point.time),
                          point.driver_version + injected_text(point));
      text += words::lines_of(point.changes);
    }
    if (const HistoryPoint* worse = device.first_worse()) {
      text +=
          fmt::format("  first store that is worse than the previous store: {}\n", worse->store);
    }
  }
  return text;
}

}  // namespace triptych::report
