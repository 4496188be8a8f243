// Sentences about the two sides of a comparison: what they are, how their times compare over all
// configurations, and which device is best for each technique.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "report/words/causes.hpp"
#include "report/words/comparison.hpp"

namespace triptych::report::words {
namespace {

using comparison::ComparisonResult;
using comparison::OverallTime;
using comparison::SideBySide;

std::string on_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

// Returns the environment variables of a side as "NAME=VALUE": those that its driver reads, and
// those that were set for this side only.
std::vector<std::string> variables_of(const record::Device& device,
                                      const std::vector<std::string>& set) {
  std::vector<std::string> variables;
  for (const auto& [name, value] : device.environment) {
    variables.push_back(on_one_line(fmt::format("{}={}", name, value)));
  }
  for (const std::string& each : set) {
    const std::string variable = on_one_line(each);
    if (std::ranges::find(variables, variable) == variables.end()) variables.push_back(variable);
  }
  return variables;
}

// Formats a shift of ln(time) as "0.9912 [0.9310, 1.0563]".
std::string ratio_text(const comparison::Shift& shift) {
  return fmt::format("{:.4f} [{:.4f}, {:.4f}]", std::exp(shift.estimate),
                     std::exp(shift.interval.low), std::exp(shift.interval.high));
}

}  // namespace

std::string version_of(const record::Device& device) {
  const std::string driver = device.driver.empty() ? "" : device.driver + ", ";
  return on_one_line(
      fmt::format("driver {}{}; API {}", driver, device.driver_version, device.api_version));
}

std::string sides(const ComparisonResult& result, bool with_base) {
  const bool same_processor = result.a.cpu_features == result.b.cpu_features;
  const auto side = [&](const char* name, const record::Device& device, std::size_t number) {
    std::string text = fmt::format("{}: {}; {}", name, device.id, version_of(device));
    if (device.cpu_features.empty() && !device.name.empty()) {
      text += fmt::format("; GPU {}", on_one_line(device.name));
    }
    std::vector<std::string> more = variables_of(device, result.environment.at(number));
    const std::string& program = result.programs.at(number);
    if (!program.empty()) more.insert(more.begin(), "program " + program);
    if (!same_processor) more.push_back("CPU " + device.cpu_features);
    for (const std::string& each : more) text += fmt::format("\n{:<14}{}", "", each);
    return text + "\n";
  };
  return side(with_base ? "a (--base)" : "a", result.a, 0) +
         side(with_base ? "b (tested)" : "b", result.b, 1);
}

std::string same_driver(const ComparisonResult& result) {
  if (result.ineffective_variables.empty()) return {};
  return fmt::format(
      "! Both sides loaded the same driver version ({}), although {} {}.\n"
      "! This driver was probably compared with itself: either the driver's manifest names its "
      "library by a relative path, so that\n"
      "! the system's library was loaded (set LD_LIBRARY_PATH for this side, too), or the driver "
      "ignores the variable. See docs/compare.md.\n",
      version_of(result.b), fmt::join(result.ineffective_variables, " and "),
      result.ineffective_variables.size() == 1 ? "differs" : "differ");
}

std::string overall(const OverallTime& time) {
  std::string text = fmt::format(
      "all configurations: geometric mean of {} time ratios {}; {} decided, {} undecided",
      time.averaged, ratio_text(time.shift), time.decided, time.undecided);
  const auto& [low, high] = time.shift.interval;
  if (low < 0 && high > 0) {
    text += fmt::format("; if there is a difference on average, it is smaller than {:.3g} %",
                        100 * std::expm1(std::max(-low, high)));
  }
  return text;
}

std::string load(double other_load) {
  return fmt::format(
      "load: {:.1f} runnable threads of other programs per CPU core while times were measured{}",
      other_load, other_load >= 0.5 ? "; the machine was too busy for exact times" : "");
}

std::string when_undecided(const std::string& exact_command) {
  std::string text =
      "undecided configurations need a machine on which nothing else is running; measuring them "
      "again on a busy machine rarely helps";
  if (exact_command.empty()) return text;
  return text + "\nto compare the work exactly, independently of the load, count instructions: " +
         exact_command;
}

std::string sentence(const SideBySide& table) {
  struct Wins {
    std::size_t all = 0;
    std::size_t significant = 0;
  };
  std::map<std::string, Wins> wins;
  for (const SideBySide::Row& row : table.rows) {
    ++wins[row.best].all;
    if (row.is_significant()) ++wins[row.best].significant;
  }
  const auto most =
      std::ranges::max_element(wins, {}, [](const auto& each) { return each.second.all; });
  const auto its = std::ranges::count_if(
      table.rows, [&](const SideBySide::Row& row) { return row.cells.contains(most->first); });
  std::string text = fmt::format("{} has the lowest cost in {} of the {} techniques measured on it",
                                 most->first, most->second.all, its);
  if (table.is_time()) text += fmt::format(" (significantly in {})", most->second.significant);
  for (const std::string& device : table.devices) {
    std::vector<double> ratios;
    for (const SideBySide::Row& row : table.rows) {
      if (device == most->first || !row.cells.contains(device)) continue;
      if (!row.cells.contains(most->first)) continue;
      ratios.push_back(row.cells.at(device).value / row.cells.at(most->first).value);
    }
    if (ratios.empty()) continue;
    text += fmt::format(
        "; the cost on {} is {:.2f} to {:.2f} times as high in the techniques measured on both "
        "devices",
        device, std::ranges::min(ratios), std::ranges::max(ratios));
  }
  return text;
}

std::string uncertainty(const SideBySide& table) {
  if (!table.is_time()) return {};
  std::string text =
      "± is the 98 % confidence interval of a ratio, and ~ marks a ratio that does not differ "
      "significantly from the best device.";
  if (table.process_runs > 1) {
    return text +
           fmt::format(" The intervals contain the variation between {} runs.", table.process_runs);
  }
  return text +
         "\nThe store contains only one run of at least one device. Times also vary between "
         "processes, which these intervals do not contain.\nTo get a ranking that you can rely on, "
         "repeat the same `triptych run` command four times with this store, or compare two "
         "devices with `triptych compare PLAN --a … --b …`.";
}

}  // namespace triptych::report::words
