#include "measure/run/same_failure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "record/factor_list.hpp"

namespace triptych::measure {
namespace {

bool ended_the_worker(record::Outcome outcome) {
  return outcome == record::Outcome::crashed || outcome == record::Outcome::hung ||
         outcome == record::Outcome::lost;
}

// Returns the factors in which two configurations of a plan differ.
std::set<std::string> differing(const Configuration& a, const Configuration& b) {
  std::set<std::string> factors;
  for (const auto& [factor, level] : a) {
    const auto found = b.find(factor);
    if (found == b.end() || found->second != level) factors.insert(factor);
  }
  return factors;
}

}  // namespace

void SameFailure::saw(const Configuration& configuration, const record::Record& record) {
  if (record.outcome == record::Outcome::measured) measured_.push_back(configuration);
  if (!ended_the_worker(record.outcome) || record.reason.not_tried) return;
  const Failure failure{
      configuration, record.outcome, record.reason,
      fmt::format("{} {}", record::name_of(record.outcome), record::kind_of(record.reason))};
  for (const Failure& before : failures_) {
    if (before.kind != failure.kind) continue;
    const Factors factors = differing(before.configuration, configuration);
    if (!is_refuted(configuration, factors))
      no_matter_[failure.kind].insert(factors.begin(), factors.end());
  }
  failures_.push_back(failure);
}

std::optional<SameFailure::Foretold> SameFailure::foretold(
    const Configuration& configuration) const {
  for (const Failure& failure : failures_) {
    const auto found = no_matter_.find(failure.kind);
    if (found == no_matter_.end()) continue;
    const Factors& no_matter = found->second;
    if (!std::ranges::includes(no_matter, differing(failure.configuration, configuration)) ||
        is_refuted(failure.configuration, no_matter)) {
      continue;
    }
    Configuration shared = failure.configuration;
    std::erase_if(shared, [&](const auto& level) {
      return no_matter.contains(level.first) ||
             std::ranges::find(varied_, level.first) == varied_.end();
    });
    Foretold foretold{failure.outcome, failure.reason};
    foretold.reason.not_tried = true;
    foretold.reason.shared_levels = record::factor_list(shared);
    return foretold;
  }
  return std::nullopt;
}

bool SameFailure::is_refuted(const Configuration& configuration, const Factors& but_for) const {
  return std::ranges::any_of(measured_, [&](const Configuration& measured) {
    return std::ranges::includes(but_for, differing(configuration, measured));
  });
}

}  // namespace triptych::measure
