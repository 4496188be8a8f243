#include "measure/same_failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/text.hpp"
#include "record/factor_list.hpp"
#include "record/not_tried.hpp"

namespace triptych::measure {
namespace {

bool ended_the_worker(record::Outcome outcome) {
  return outcome == record::Outcome::crashed || outcome == record::Outcome::hung ||
         outcome == record::Outcome::lost;
}

Configuration shared_by(const Configuration& a, const Configuration& b) {
  Configuration shared;
  std::ranges::set_intersection(a, b, std::inserter(shared, shared.end()));
  return shared;
}

}  // namespace

void SameFailure::saw(const Configuration& configuration, const record::Record& record) {
  if (record.outcome == record::Outcome::measured) measured_.push_back(configuration);
  if (!ended_the_worker(record.outcome) || record::was_not_tried(record)) return;
  const Failure failure{configuration, record.outcome, record.reason};
  for (const Failure& before : failures_) {
    if (before.outcome != failure.outcome ||
        core::without_numbers(before.reason) != core::without_numbers(failure.reason)) {
      continue;
    }
    Configuration shared = shared_by(before.configuration, configuration);
    if (shared.contains("technique")) causes_.push_back({std::move(shared), failure});
  }
  failures_.push_back(failure);
}

std::optional<SameFailure::Foretold> SameFailure::foretold(
    const Configuration& configuration) const {
  const auto cause = std::ranges::find_if(causes_, [&](const Cause& each) {
    return std::ranges::includes(configuration, each.shared) && !is_refuted(each);
  });
  if (cause == causes_.end()) return std::nullopt;
  Configuration named = cause->shared;
  std::erase_if(named, [&](const auto& level) {
    return std::ranges::find(varied_, level.first) == varied_.end();
  });
  return Foretold{
      cause->failure.outcome,
      fmt::format("{}{}{}", cause->failure.reason, record::not_tried, record::factor_list(named))};
}

bool SameFailure::is_refuted(const Cause& cause) const {
  return std::ranges::any_of(measured_, [&](const Configuration& measured) {
    return std::ranges::includes(measured, cause.shared);
  });
}

}  // namespace triptych::measure
