#include "accuracy/choice.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace triptych::accuracy {

std::optional<StepError> longest_step(double error, const StepLimits& limits,
                                      const std::function<double(double)>& error_of) {
  std::map<double, double> known;
  const auto holds = [&](double step) {
    const auto [entry, fresh] = known.try_emplace(step, 0.0);
    if (fresh) entry->second = error_of(step);
    return entry->second <= error;
  };
  const auto holds_from = [&](double step) {
    return holds(step) && (step / 2 < limits.shortest || holds(step / 2));
  };
  // From a few voxels, where steps of ordinary pictures lie, up or down by octaves.
  double step = std::clamp(4.0, limits.shortest, limits.longest);
  while (!holds_from(step)) {
    if (step / 2 < limits.shortest) return std::nullopt;
    step /= 2;
  }
  while (2 * step <= limits.longest && holds(2 * step)) step *= 2;
  for (const double quarters : {0.75, 0.5, 0.25}) {
    const double longer = step * std::exp2(quarters);
    if (longer <= limits.longest && holds(longer)) {
      step = longer;
      break;
    }
  }
  return StepError{.step = step, .error = known.at(step)};
}

std::optional<std::size_t> cheapest(std::span<const AccuracyCase> cases, double error) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!cases[i].time_ns || !(cases[i].rmse <= error)) continue;
    if (!best || *cases[i].time_ns < *cases[*best].time_ns) best = i;
  }
  return best;
}

}  // namespace triptych::accuracy
