#include "report/screen/comparison_screen.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "record/short_name.hpp"
#include "report/words/comparison.hpp"
#include "report/words/history.hpp"

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

constexpr std::size_t widest_line = 200;
constexpr const char* indented = "\n              ";

// Breaks lines that are wider than widest_line at spaces. Continuation lines are indented.
std::string broken_lines(std::string_view text) {
  std::string result;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n", 1), text.size());
    const std::string_view word = text.substr(0, end);
    const std::size_t width = core::character_count(word);
    if (word.front() == '\n') {
      column = width - 1;
      result += word;
    } else if (word.front() == ' ' && column + width > widest_line) {
      result += indented;
      result += word.substr(1);
      column = std::string_view(indented).size() - 1 + width - 1;
    } else {
      column += width;
      result += word;
    }
    text.remove_prefix(end);
  }
  return result;
}

bool is_undecided(const ComparedConfiguration& compared) {
  return compared.has_time() && compared.verdict == comparison::PairVerdict::undecided;
}

std::string line_of(const ComparedConfiguration& compared, const ComparisonCommand& command) {
  std::string line = fmt::format("{:<12}", compared.verdict_name());
  if (compared.has_time()) {
    line += milliseconds_of(compared) + ratio_of(compared.shift);
    line += compared.process_runs > 0
                ? fmt::format("  {} repetitions in new processes", compared.process_runs)
                : fmt::format("  {} measurement blocks", compared.blocks);
    line += fmt::format(", {} clock", name_of(compared.clock));
  }
  line += fmt::format("  {:.1f} s  {}", compared.seconds, record::short_name(compared.key));
  if (!compared.reason.empty()) line += indented + words::text_of(compared.reason);
  if (const std::string work = work_of(compared); !work.empty()) line += indented + work;
  line = broken_lines(line + "\n");
  if (is_undecided(compared) && compared.out_of_budget) {
    line += fmt::format("{:<14}to reach a verdict, run: {}\n", "", command_for(compared, command));
  }
  return line;
}

// Returns one line for each configuration. Unless everything is to be listed, only the first few
// undecided configurations are.
std::string times_of(const ComparisonResult& result, const ComparisonCommand& command) {
  constexpr int most_undecided = 3;
  std::string text =
      "each line contains the median times of a and b with their quartiles, and the time of b "
      "divided by the time of a with its confidence interval, from the same measurements:\n";
  int undecided = 0;
  for (const ComparedConfiguration& compared : result.configurations) {
    const bool folded = is_undecided(compared) && ++undecided > most_undecided && !command.verbose;
    if (!folded) text += line_of(compared, command);
  }
  if (undecided > most_undecided && !command.verbose) {
    text += fmt::format("{:<12}{} more; --verbose lists them, and --json contains all of them\n",
                        name_of(comparison::PairVerdict::undecided), undecided - most_undecided);
  }
  return text;
}

// Returns the lines about all configurations together, and the advice for undecided ones.
std::string conclusion_of(const ComparisonResult& result, const ComparisonCommand& command) {
  std::string text;
  if (const auto overall = result.overall_time()) text += words::overall(*overall) + "\n";
  const bool timed = std::ranges::any_of(result.configurations, &ComparedConfiguration::has_time);
  if (timed && result.other_load) text += words::load(*result.other_load) + "\n";
  const bool exhausted =
      std::ranges::any_of(result.configurations, [](const ComparedConfiguration& compared) {
        return is_undecided(compared) && !compared.out_of_budget;
      });
  if (exhausted) text += words::when_undecided(exact_command(command)) + "\n";
  return text;
}

std::string lines_of(const std::vector<comparison::DifferenceGroup>& groups, bool verbose) {
  std::string text = words::lines_of(groups, verbose);
  const bool folded = std::ranges::any_of(groups, [](const auto& each) { return each.count > 1; });
  if (folded && !verbose) text += "--verbose lists every configuration with a difference\n";
  return text;
}

std::string differences_of(const ComparisonResult& result, bool verbose) {
  const auto groups = result.groups();
  if (!groups.empty()) return lines_of(groups, verbose);
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

// Returns the calibration results of the clocks that are not trusted.
std::string calibrations_of(const ComparisonResult& result) {
  std::string text;
  for (const measure::Side side : {measure::Side::a, measure::Side::b}) {
    for (const record::ClockTrust& clock : result.clocks.at(side == measure::Side::a ? 0 : 1)) {
      if (clock.trusted) continue;
      text += fmt::format("{:<14}side {}, {}: {}\n", "", measure::name_of(side), clock.work,
                          clock.verdict);
    }
  }
  return text;
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
  const auto uncalibrated = [](const auto& each) {
    return each.first != comparison::WallClockCause::implausible;
  };
  if (std::ranges::any_of(causes, uncalibrated)) text += calibrations_of(result);
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

std::string lines_of(const DeviceChange& change, bool verbose) {
  const auto groups = groups_of(change);
  return fmt::format("{}, {} configurations\na: {}\nb: {}\n{}\n", change.a.id,
                     change.configurations.size(), words::version_of(change.a),
                     words::version_of(change.b),
                     groups.empty() ? no_difference(change) : lines_of(groups, verbose));
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
  const std::string warning = words::same_driver(result);
  std::string text = command.plan + "\n" + words::sides(result, command.base) + warning +
                     broken_lines(differences_of(result, command.verbose));
  if (result.timed) {
    text += times_of(result, command) + broken_lines(clocks_of(result)) +
            conclusion_of(result, command);
  }
  return text + words::headline(result) + "\n";
}

std::string screen_of(const comparison::StoreDiff& diff, bool verbose) {
  std::string text;
  for (const DeviceChange& change : diff.devices) text += lines_of(change, verbose);
  for (const comparison::OneSidedEntry& each : diff.one_sided) {
    text += fmt::format("{:<12}  {}\n", comparison::name_of(DifferenceKind::unjudged),
                        words::text_of(each));
  }
  return text;
}

std::string screen_of(const std::vector<comparison::DeviceHistory>& history) {
  const auto names = names_of(history);
  bool has_times = false;
  std::string text;
  for (const comparison::DeviceHistory& device : history) {
    text += fmt::format(
        "{} (cost and time are relative to the first store)\n  {:<28} {:<20} {:>9} {:>9}  {:<30} "
        "driver\n",
        device.device, "store", "started", "cost", "time", "time / time in previous store");
    for (const HistoryPoint& point : device.points) {
      const std::string change = words::text_of(point.time_change);
      text +=
          fmt::format("  {:<28} {:<20} {:>9} {:>9}  {:<30} {}\n", names.at(point.store),
                      point.started_at, number(point.cost), number(point.time),
                      change.empty() ? "–" : change, point.driver_version + injected_text(point));
      if (const std::string clocks = words::changed_clocks(point); !clocks.empty()) {
        text += fmt::format("    {}\n", clocks);
      }
      has_times = has_times || point.time_change;
      text += words::lines_of(point.changes);
    }
    if (const HistoryPoint* worse = device.first_worse()) {
      text +=
          fmt::format("  first store that is worse than the previous store: {}\n", worse->store);
    }
  }
  if (has_times) text += fmt::format("{}\n", words::noise_note());
  return text;
}

}  // namespace triptych::report
