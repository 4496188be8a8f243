#include "accuracy/choice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace triptych::accuracy {

StepError longest_step(double error, const StepLimits& limits, const ErrorOfStep& error_of) {
  std::map<double, double> known;
  const auto meets_error = [&](double step) {
    const auto [entry, is_new] = known.try_emplace(step, 0.0);
    if (is_new) entry->second = error_of(step);
    return entry->second <= error;
  };
  const auto meets_error_down_from = [&](double step) {
    return meets_error(step) && (step / 2 < limits.shortest || meets_error(step / 2));
  };
  // The search starts at a step of a few voxels, which is a typical result, and then halves or
  // doubles the step.
  double step = std::clamp(4.0, limits.shortest, limits.longest);
  while (!meets_error_down_from(step)) {
    if (step / 2 < limits.shortest) return {.step = step, .error = known.at(step)};
    step /= 2;
  }
  while (2 * step <= limits.longest && meets_error(2 * step)) step *= 2;
  for (const double quarters : {0.75, 0.5, 0.25}) {
    const double longer = step * std::exp2(quarters);
    if (longer <= limits.longest && meets_error(longer)) {
      step = longer;
      break;
    }
  }
  return {.step = step, .error = known.at(step)};
}

ImageSize search_size(const ImageSize& image) {
  constexpr double most_pixels = 48.0 * 48.0;
  constexpr int shortest_side = 8;
  const int longer = std::max(image.width, image.height);
  const int shorter = std::min(image.width, image.height);
  const double scale = std::min(std::sqrt(most_pixels / longer / shorter), 1.0);
  const int side = std::max(static_cast<int>(shorter * scale), std::min(shorter, shortest_side));
  const int other =
      std::clamp(static_cast<int>(std::min(longer * scale, most_pixels / side)), side, longer);
  return image.width >= image.height ? ImageSize{other, side} : ImageSize{side, other};
}

std::optional<std::size_t> cheapest(std::span<const TimedError> cases, double error) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!cases[i].time_ns || !(cases[i].error <= error)) continue;
    if (!best || *cases[i].time_ns < *cases[*best].time_ns) best = i;
  }
  return best;
}

}  // namespace triptych::accuracy
