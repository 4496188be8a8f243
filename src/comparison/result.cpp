#include <algorithm>

#include "comparison/comparison.hpp"

namespace triptych::comparison {
namespace {

using judge::PairVerdict;

bool has(const Compared& compared, judge::DifferenceKind kind) {
  return std::ranges::any_of(compared.differences,
                             [kind](const auto& each) { return each.kind == kind; });
}

}  // namespace

bool Compared::is_regression() const {
  return (!ended && verdict == PairVerdict::slower) ||
         has(*this, judge::DifferenceKind::regression);
}

bool Compared::is_doubtful() const {
  if (has(*this, judge::DifferenceKind::unjudged)) return true;
  return ended ? *ended != record::Outcome::skipped : verdict == PairVerdict::undecided;
}

std::string_view Compared::verdict_name() const {
  if (ended) return *ended == record::Outcome::skipped ? "skipped" : "cannot tell";
  return judge::name_of(verdict);
}

core::ExitCode ComparisonResult::exit_code() const {
  const auto any = [this](auto member) {
    return std::ranges::any_of(configurations,
                               [&](const Compared& each) { return (each.*member)(); });
  };
  if (any(&Compared::is_regression)) return core::ExitCode::regression;
  const bool measured =
      std::ranges::any_of(configurations, [](const Compared& each) { return each.blocks > 0; });
  return measured && !any(&Compared::is_doubtful) ? core::ExitCode::pass
                                                  : core::ExitCode::cannot_judge;
}

}  // namespace triptych::comparison
