#include <algorithm>

#include "comparison/comparison.hpp"

namespace triptych::comparison {
namespace {

bool has(const Compared& compared, DifferenceKind kind) {
  return std::ranges::any_of(compared.differences,
                             [kind](const auto& each) { return each.kind == kind; });
}

}  // namespace

bool Compared::is_regression() const {
  return (!ended && verdict == PairVerdict::slower) || has(*this, DifferenceKind::regression);
}

bool Compared::is_doubtful(bool timed) const {
  if (has(*this, DifferenceKind::unjudged)) return true;
  if (has(*this, DifferenceKind::fixed)) return false;
  if (ended) return *ended != record::Outcome::skipped;
  return timed && verdict == PairVerdict::undecided;
}

std::string_view Compared::verdict_name() const {
  if (ended)
    return *ended == record::Outcome::skipped ? "skipped" : name_of(PairVerdict::undecided);
  return name_of(verdict);
}

core::ExitCode ComparisonResult::exit_code() const {
  const auto any = [this](const auto& is) { return std::ranges::any_of(configurations, is); };
  if (any([](const Compared& each) { return each.is_regression(); })) {
    return core::ExitCode::regression;
  }
  const bool looked = any([](const Compared& each) { return !each.ended; });
  const bool doubtful = any([this](const Compared& each) { return each.is_doubtful(timed); });
  return looked && !doubtful ? core::ExitCode::pass : core::ExitCode::cannot_judge;
}

std::vector<DifferenceGroup> ComparisonResult::groups() const {
  std::vector<Located> all;
  for (const Difference& each : device) all.emplace_back("", each);
  for (const Compared& compared : configurations) {
    for (const Difference& each : compared.differences) all.emplace_back(compared.key, each);
  }
  return grouped(all);
}

}  // namespace triptych::comparison
