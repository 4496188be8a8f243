#include "comparison/difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

#include "comparison/time_reason.hpp"
#include "record/names.hpp"

namespace triptych::comparison {
namespace {

using record::Names;

constexpr Names<DifferenceKind, 5> kind_names{{
    {DifferenceKind::regression, "regression"},
    {DifferenceKind::unjudged, "cannot judge"},
    {DifferenceKind::fixed, "fixed"},
    {DifferenceKind::calibration, "calibration"},
    {DifferenceKind::changed, "changed"},
}};

constexpr Names<Subject, 10> subject_names{{
    {Subject::outcome, "outcome"},
    {Subject::image, "image"},
    {Subject::cost, "cost"},
    {Subject::preparing, "cost of preparing"},
    {Subject::code, "code"},
    {Subject::code_total, "code total"},
    {Subject::memory, "memory"},
    {Subject::counter, "counter"},
    {Subject::statistic, "statistic"},
    {Subject::limit, "limit"},
}};

constexpr Names<DifferenceCause, 20> cause_names{{
    {DifferenceCause::ended, "ended"},
    {DifferenceCause::only_one_side, "only_one_side"},
    {DifferenceCause::no_reference, "no_reference"},
    {DifferenceCause::wrong_image, "wrong_image"},
    {DifferenceCause::other_bits, "other_bits"},
    {DifferenceCause::other_bits_of_one_code, "other_bits_of_one_code"},
    {DifferenceCause::two_counters, "two_counters"},
    {DifferenceCause::values_changed, "values_changed"},
    {DifferenceCause::code_changed, "code_changed"},
    {DifferenceCause::code_total, "code_total"},
    {DifferenceCause::reported_by_one_side, "reported_by_one_side"},
    {DifferenceCause::same_driver, "same_driver"},
    {DifferenceCause::api_specific, "api_specific"},
    {DifferenceCause::beyond_rounding, "beyond_rounding"},
    {DifferenceCause::within_rounding, "within_rounding"},
    {DifferenceCause::drivers_must_agree, "drivers_must_agree"},
    {DifferenceCause::drivers_may_differ, "drivers_may_differ"},
    {DifferenceCause::counted_differently, "counted_differently"},
    {DifferenceCause::calibration_changed, "calibration_changed"},
    {DifferenceCause::limit_changed, "limit_changed"},
}};

constexpr Names<TimeCause, 8> time_cause_names{{
    {TimeCause::none, "none"},
    {TimeCause::side_ended, "side_ended"},
    {TimeCause::only_one_side, "only_one_side"},
    {TimeCause::wrong_image, "wrong_image"},
    {TimeCause::no_fresh_process_runs, "no_fresh_process_runs"},
    {TimeCause::not_confirmed, "not_confirmed"},
    {TimeCause::undecided, "undecided"},
    {TimeCause::budget_ended, "budget_ended"},
}};

constexpr Names<WallClockCause, 5> wall_clock_cause_names{{
    {WallClockCause::none, "none"},
    {WallClockCause::a_not_calibrated, "a_not_calibrated"},
    {WallClockCause::b_not_calibrated, "b_not_calibrated"},
    {WallClockCause::neither_calibrated, "neither_calibrated"},
    {WallClockCause::implausible, "implausible"},
}};

// Returns the size of a change, regardless of its direction.
double size_of(double ratio) {
  return std::abs(std::log(ratio));
}

// Returns the largest relative change of a code statistic that affects the verdict. A statistic
// that was 0 before, such as spilled registers, has an infinite change.
double size_of(const judge::CodeComparison& code, bool only_worse) {
  double largest = 0;
  for (const judge::CodeChange& each : code.changes) {
    if (!each.statistic.decides || (only_worse && !each.worse())) continue;
    const bool both = each.before > 0 && each.now > 0;
    largest = std::max(
        largest, both ? size_of(each.now / each.before) : std::numeric_limits<double>::infinity());
  }
  return largest;
}

void set_members(std::vector<LocatedDifference> members, DifferenceGroup& group) {
  std::ranges::stable_sort(members, std::ranges::greater(),
                           [](const LocatedDifference& each) { return each.second.size(); });
  group.where = members.front().first;
  group.difference = members.front().second;
  group.count = static_cast<int>(members.size());
  for (const auto& [where, difference] : members) {
    if (!difference.ratio) continue;
    const double ratio = *difference.ratio;
    auto& ratios = group.ratios;
    ratios = ratios ? std::pair(std::min(ratios->first, ratio), std::max(ratios->second, ratio))
                    : std::pair(ratio, ratio);
  }
  group.members = std::move(members);
}

}  // namespace

std::string_view name_of(DifferenceKind kind) {
  return record::name_in(kind_names, kind);
}
std::string_view name_of(Subject subject) {
  return record::name_in(subject_names, subject);
}
std::string_view name_of(DifferenceCause cause) {
  return record::name_in(cause_names, cause);
}
std::string_view name_of(TimeCause cause) {
  return record::name_in(time_cause_names, cause);
}
std::string_view name_of(WallClockCause cause) {
  return record::name_in(wall_clock_cause_names, cause);
}

double Difference::size() const {
  if (ratio) return size_of(*ratio);
  if (code) return size_of(*code, kind == DifferenceKind::regression);
  if (const auto error = numbers.find("error"); error != numbers.end()) return error->second;
  return sides[1] ? sides[1]->number("max_error") : 0;
}

std::string Difference::about() const {
  return name.empty() ? std::string(name_of(subject))
                      : fmt::format("{} {}", name_of(subject), name);
}

std::vector<DifferenceGroup> grouped(const std::vector<LocatedDifference>& differences) {
  using Key = std::tuple<DifferenceKind, std::string, std::string>;  // kind, measurement, faults
  std::map<Key, std::vector<LocatedDifference>> groups;
  for (const LocatedDifference& each : differences) {
    const Difference& difference = each.second;
    groups[{difference.kind, difference.about(), difference.injected}].push_back(each);
  }
  std::vector<DifferenceGroup> sorted;
  for (auto& [key, members] : groups) set_members(std::move(members), sorted.emplace_back());
  return sorted;
}

}  // namespace triptych::comparison
