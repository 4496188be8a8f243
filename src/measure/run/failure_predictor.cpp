#include "measure/run/failure_predictor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "record/factor_list.hpp"

namespace triptych::measure {
namespace {

bool ends_worker(record::Outcome outcome) {
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

void FailurePredictor::add(const Configuration& configuration, const record::Record& record) {
  if (record.outcome == record::Outcome::measured) measured_.push_back(configuration);
  if (!ends_worker(record.outcome) || record.reason.not_tried) return;
  const Failure failure{
      configuration, record.outcome, record.reason,
      fmt::format("{} {}", record::name_of(record.outcome), record::kind_of(record.reason))};
  for (const Failure& earlier : failures_) {
    if (earlier.kind != failure.kind) continue;
    const Factors factors = differing(earlier.configuration, configuration);
    if (!is_refuted(configuration, factors))
      irrelevant_[failure.kind].insert(factors.begin(), factors.end());
  }
  failures_.push_back(failure);
}

std::optional<FailurePredictor::Prediction> FailurePredictor::predict(
    const Configuration& configuration) const {
  for (const Failure& failure : failures_) {
    const auto found = irrelevant_.find(failure.kind);
    if (found == irrelevant_.end()) continue;
    const Factors& irrelevant = found->second;
    if (!std::ranges::includes(irrelevant, differing(failure.configuration, configuration)) ||
        is_refuted(failure.configuration, irrelevant)) {
      continue;
    }
    Configuration shared = failure.configuration;
    std::erase_if(shared, [&](const auto& level) {
      return irrelevant.contains(level.first) ||
             std::ranges::find(varied_, level.first) == varied_.end();
    });
    Prediction prediction{failure.outcome, failure.reason};
    prediction.reason.not_tried = true;
    prediction.reason.shared_levels = record::factor_list(shared);
    return prediction;
  }
  return std::nullopt;
}

bool FailurePredictor::is_refuted(const Configuration& configuration,
                                  const Factors& ignored) const {
  return std::ranges::any_of(measured_, [&](const Configuration& measured) {
    return std::ranges::includes(ignored, differing(configuration, measured));
  });
}

}  // namespace triptych::measure
