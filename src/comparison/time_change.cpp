#include "comparison/time_change.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace triptych::comparison {
namespace {

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace

bool TimeChange::is_noise() const {
  return std::abs(std::log(ratio)) <= half_width;
}

std::optional<TimeChange> time_change(std::span<const TimePair> pairs) {
  if (pairs.empty()) return std::nullopt;
  constexpr double two_sided_95_percent = 1.96;
  std::vector<double> changes;
  std::vector<double> spreads;
  for (const TimePair& pair : pairs) {
    changes.push_back(std::log(pair.now_ns / pair.before_ns));
    spreads.push_back(std::hypot(pair.spread_before, pair.spread_now));
  }
  const double spread = std::max(mean_of(spreads), deviation_of(changes));
  return TimeChange{.ratio = std::exp(mean_of(changes)),
                    .half_width = two_sided_95_percent * spread};
}

}  // namespace triptych::comparison
