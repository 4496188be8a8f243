#include <algorithm>
#include <cmath>

#include "comparison/comparison.hpp"

namespace triptych::comparison {
namespace {

bool has(const ComparedConfiguration& compared, DifferenceKind kind) {
  return std::ranges::any_of(compared.differences,
                             [kind](const auto& each) { return each.kind == kind; });
}

}  // namespace

bool ComparedConfiguration::is_regression() const {
  return (!ended && verdict == PairVerdict::slower) || has(*this, DifferenceKind::regression);
}

bool ComparedConfiguration::is_inconclusive(bool timed) const {
  if (has(*this, DifferenceKind::unjudged)) return true;
  if (has(*this, DifferenceKind::fixed)) return false;
  if (ended) return *ended != record::Outcome::skipped;
  return timed && verdict == PairVerdict::undecided;
}

std::string_view ComparedConfiguration::verdict_name() const {
  if (ended)
    return *ended == record::Outcome::skipped ? "skipped" : name_of(PairVerdict::undecided);
  return name_of(verdict);
}

core::ExitCode ComparisonResult::exit_code() const {
  const auto any = [this](const auto& is) { return std::ranges::any_of(configurations, is); };
  if (any([](const ComparedConfiguration& each) { return each.is_regression(); })) {
    return core::ExitCode::regression;
  }
  const bool any_measured = any([](const ComparedConfiguration& each) { return !each.ended; });
  const bool inconclusive =
      any([this](const ComparedConfiguration& each) { return each.is_inconclusive(timed); });
  return any_measured && !inconclusive ? core::ExitCode::pass : core::ExitCode::cannot_judge;
}

std::vector<DifferenceGroup> ComparisonResult::groups() const {
  std::vector<LocatedDifference> all;
  for (const Difference& each : device) all.emplace_back("", each);
  for (const ComparedConfiguration& compared : configurations) {
    for (const Difference& each : compared.differences) all.emplace_back(compared.key, each);
  }
  return grouped(all);
}

std::optional<OverallTime> ComparisonResult::overall_time() const {
  OverallTime overall;
  for (const ComparedConfiguration& compared : configurations) {
    if (!compared.has_time()) continue;
    ++(compared.verdict == PairVerdict::undecided ? overall.undecided : overall.decided);
    const Shift& shift = compared.shift;
    if (!std::isfinite(shift.interval.low) || !std::isfinite(shift.interval.high)) continue;
    ++overall.averaged;
    overall.shift.estimate += shift.estimate;
    overall.shift.interval.low += shift.interval.low;
    overall.shift.interval.high += shift.interval.high;
  }
  if (overall.averaged < 2) return std::nullopt;
  for (double* sum :
       {&overall.shift.estimate, &overall.shift.interval.low, &overall.shift.interval.high}) {
    *sum /= overall.averaged;
  }
  return overall;
}

}  // namespace triptych::comparison
