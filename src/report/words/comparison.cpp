#include "report/words/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

#include "report/words/cause.hpp"
#include "report/words/causes.hpp"
#include "report/words/code.hpp"
#include "report/words/finding.hpp"
#include "report/words/outcome.hpp"

namespace triptych::report::words {
namespace {

using comparison::BySide;
using comparison::Difference;
using comparison::DifferenceCause;
using comparison::DifferenceKind;
using comparison::PairVerdict;
using comparison::TimeCause;
using comparison::TimeReason;
using comparison::WallClockCause;
using measure::Side;

std::string side_name(Side side) {
  return fmt::format("side {}", measure::name_of(side));
}

// Returns "side b crashed: …; side a failed: …". Side b comes first, because it is the side under
// test.
template <typename T>
std::string by_side(const BySide<T>& sides, std::string_view between) {
  std::string text;
  for (const Side side : {Side::b, Side::a}) {
    const auto& what = sides.at(side == Side::a ? 0 : 1);
    if (!what) continue;
    text +=
        fmt::format("{}{}{}{}", text.empty() ? "" : "; ", side_name(side), between, text_of(*what));
  }
  return text;
}

std::string other_bits(const Difference& difference) {
  const auto number = [&](const char* name) { return difference.numbers.at(name); };
  std::string text = fmt::format(
      "{:.0f} of {:.0f} pixels differ; largest difference {:.3g} at ({:.0f}, {:.0f}), RMS "
      "difference {:.3g}",
      number("pixels"), number("total"), number("error"), number("x"), number("y"), number("rmse"));
  if (difference.numbers.contains("particles")) {
    text += fmt::format("; {} a different particle",
                        counted(number("particles"), "pixel shows", "pixels show"));
  }
  return text;
}

std::string changes_text(const Difference& difference) {
  std::string text;
  for (const judge::Change& each : difference.changes) {
    text += (text.empty() ? "" : "; ") + text_of(each);
  }
  return text;
}

// Returns the values of a counter or statistic, without its name: "1000 → 1001 (+0.1 %)".
std::string values(const Difference& difference) {
  const judge::Change& change = difference.changes.at(0);
  if (!change.before || !change.now) {
    return fmt::format("{:.0f}", change.before ? *change.before : change.now.value_or(0));
  }
  std::string text = fmt::format("{:.0f} → {:.0f}", *change.before, *change.now);
  if (*change.before > 0) text += fmt::format(" ({})", percent(*change.now / *change.before));
  return text;
}

std::string limit_changed(const Difference& difference) {
  const auto before = difference.facts.find("a");
  const auto now = difference.facts.find("b");
  if (before == difference.facts.end()) return fmt::format("new, {}", now->second);
  if (now == difference.facts.end())
    return fmt::format("no longer reported; it was {}", before->second);
  return fmt::format("{} → {}", before->second, now->second);
}

std::string sentence_of(const Difference& difference) {
  switch (difference.cause) {
    case DifferenceCause::ended:
      return by_side(difference.sides, " ");
    case DifferenceCause::only_one_side:
      return fmt::format("exists only on {}", side_name(*difference.side));
    case DifferenceCause::no_reference:
    case DifferenceCause::wrong_image:
      return by_side(difference.sides, ": ");
    case DifferenceCause::other_bits:
      return other_bits(difference);
    case DifferenceCause::other_bits_of_one_code:
      return "the images differ, although the device and the device code are the same: " +
             other_bits(difference);
    case DifferenceCause::two_counters:
      return fmt::format(
          "not comparable: the counts of side a come from {}, those of side b from {}",
          difference.facts.at("a"), difference.facts.at("b"));
    case DifferenceCause::values_changed:
      return changes_text(difference);
    case DifferenceCause::code_changed:
      return text_of(*difference.code);
    case DifferenceCause::code_total:
      return text_of(*difference.total);
    case DifferenceCause::reported_by_one_side:
      return fmt::format("reported only by {}: {}", side_name(*difference.side),
                         values(difference));
    case DifferenceCause::same_driver:
      return values(difference) + ", although the driver is the same";
    case DifferenceCause::api_specific:
      return values(difference) + "; the value depends on the API";
    case DifferenceCause::beyond_rounding:
      return values(difference) + ", which is more than rounding can explain";
    case DifferenceCause::within_rounding:
      return values(difference) + ", which rounding can explain";
    case DifferenceCause::drivers_must_agree:
      return values(difference) + ", although the APIs define this value exactly";
    case DifferenceCause::drivers_may_differ:
      return values(difference) + "; the APIs leave this value to the driver";
    case DifferenceCause::counted_differently:
      return fmt::format("{}; {}", values(difference), by_side(difference.worths, ": "));
    case DifferenceCause::calibration_changed:
      return fmt::format("{} → {}", text_of(*difference.worths[0]), text_of(*difference.worths[1]));
    case DifferenceCause::limit_changed:
      return limit_changed(difference);
  }
  return {};
}

std::string range_of(const std::pair<double, double>& ratios) {
  const std::string least = percent(ratios.first);
  const std::string largest = percent(ratios.second);
  return least == largest ? least : least + " to " + largest;
}

// Returns the number of configurations with each verdict: "18 slower, 3 same".
std::string verdicts(const comparison::ComparisonResult& result) {
  std::map<std::string_view, int> numbers;
  for (const auto& compared : result.configurations) ++numbers[compared.verdict_name()];
  std::string text;
  for (const std::string_view verdict :
       {name_of(PairVerdict::slower), name_of(PairVerdict::faster), name_of(PairVerdict::same),
        name_of(PairVerdict::undecided), record::name_of(record::Outcome::skipped)}) {
    if (!numbers.contains(verdict)) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", numbers.at(verdict), verdict);
  }
  return text;
}

}  // namespace

std::string text_of(const Difference& difference) {
  std::string text = sentence_of(difference);
  if (!difference.injected.empty()) text += fmt::format(" [injected: {}]", difference.injected);
  return text;
}

std::string text_of(const comparison::DifferenceGroup& group) {
  std::string text = text_of(group.difference);
  if (!group.where.empty()) text = fmt::format("{}: {}", group.where, text);
  if (group.count <= 1) return text;
  if (group.ratios) {
    return fmt::format("{} in {} configurations; largest change in {}", range_of(*group.ratios),
                       group.count, text);
  }
  const bool sized = group.difference.size() > 0;
  return fmt::format("in {} configurations{} in {}", group.count,
                     sized ? "; largest change" : ", for example", text);
}

std::string lines_of(const std::vector<comparison::DifferenceGroup>& groups, bool all) {
  std::string text;
  for (const comparison::DifferenceGroup& group : groups) {
    text += fmt::format("{:<12}  {}: {}\n", comparison::name_of(group.difference.kind),
                        group.difference.about(), text_of(group));
    if (!all || group.count <= 1) continue;
    for (const auto& [where, difference] : group.members) {
      text += fmt::format("{:<14}{}: {}\n", "", where, text_of(difference));
    }
  }
  return text;
}

std::string text_of(const TimeReason& reason) {
  const std::string side = side_name(reason.side);
  const std::string_view suspected = name_of(reason.suspected);
  const auto number = [&](const char* name) {
    const auto found = reason.numbers.find(name);
    return found == reason.numbers.end() ? 0 : found->second;
  };
  const auto limit = [&] {
    if (!reason.numbers.contains("most")) return std::string();
    return fmt::format("; if there is a difference, it is smaller than {:.3g} %",
                       100 * std::expm1(number("most")));
  };
  switch (reason.cause) {
    case TimeCause::none:
      return {};
    case TimeCause::side_ended:
      return fmt::format("{} {}", side, text_of(reason.outcome, reason.reason));
    case TimeCause::only_one_side:
      return fmt::format("exists only on {}", side);
    case TimeCause::wrong_image:
      return fmt::format("the image of {} is wrong, so its time is meaningless", side);
    case TimeCause::no_fresh_process_runs:
      return fmt::format(
          "{} in the first process, but this is not confirmed, because the measurement could not "
          "be repeated in new processes",
          suspected);
    case TimeCause::not_confirmed:
      return fmt::format(
          "{} ({}) in the first process, but {:.0f} repetitions in new processes did not confirm "
          "this{}",
          suspected, percent(number("ratio")), number("process_runs"), limit());
    case TimeCause::undecided:
      return fmt::format("undecided after {:.0f} measurement blocks, the maximum{}",
                         number("blocks"), limit());
    case TimeCause::budget_ended:
      return fmt::format("the time budget was used up after {:.0f} measurement blocks{}",
                         number("blocks"), limit());
  }
  return {};
}

std::string text_of(WallClockCause cause) {
  switch (cause) {
    case WallClockCause::none:
      return {};
    case WallClockCause::a_not_calibrated:
      return "the device clock of side a failed its calibration";
    case WallClockCause::b_not_calibrated:
      return "the device clock of side b failed its calibration";
    case WallClockCause::neither_calibrated:
      return "the device clocks of both sides failed their calibrations";
    case WallClockCause::implausible:
      return "the device clock reported implausible times";
  }
  return {};
}

std::string text_of(const comparison::OneSidedEntry& only) {
  const std::string side = side_name(only.side);
  if (only.device.empty()) return fmt::format("plan {} exists only on {}", only.plan, side);
  return fmt::format("{} on {} exists only on {}", only.plan, only.device, side);
}

std::string stage_of(const comparison::ComparisonProgress& progress) {
  switch (progress.stage) {
    case comparison::ComparisonStage::deterministic:
      return "deterministic measurements";
    case comparison::ComparisonStage::first_look:
      return "first estimate of the frame times";
    case comparison::ComparisonStage::more_blocks:
      return "additional measurement blocks";
    case comparison::ComparisonStage::fresh_process_runs:
      return fmt::format("repetition {} of {} in a new process", progress.process_run,
                         progress.process_runs);
  }
  return {};
}

std::string nothing_compared(const TimeReason& first) {
  const std::string why = text_of(first);
  return fmt::format("nothing was compared: no configuration was measured on both sides{}{}",
                     why.empty() ? "" : "; ", why);
}

std::string headline(const comparison::ComparisonResult& result) {
  std::map<DifferenceKind, int> kinds;
  for (const auto& compared : result.configurations) {
    for (const Difference& difference : compared.differences) ++kinds[difference.kind];
  }
  const std::string times = result.timed ? verdicts(result) : "";
  return fmt::format(
      "{}: {}{}{}, {} fixed, {} changed; {:.0f} s{}", verdict_word(result.exit_code()), times,
      times.empty() ? "" : "; ",
      counted(kinds[DifferenceKind::regression], "deterministic regression",
              "deterministic regressions"),
      kinds[DifferenceKind::fixed], kinds[DifferenceKind::changed], result.seconds,
      result.ineffective_variables.empty() ? "" : "; ! both sides loaded the same driver version");
}

std::string fails_differently(const judge::Observation& first,
                              const std::optional<judge::Observation>& again) {
  return fmt::format(
      "the frame cannot be reduced, because it fails differently when it is drawn again. "
      "First: {}. Then: {}",
      text_of(first), again ? text_of(*again) : "it did not fail");
}

}  // namespace triptych::report::words
