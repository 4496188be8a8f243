#include "accuracy/hypervolume.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::accuracy {

double hypervolume(std::span<const AccuracyCase> cases, std::span<const std::size_t> front,
                   double reference_error) {
  double area = 0;
  double reached = reference_error;
  for (const std::size_t i : front) {  // sorted by increasing time and decreasing error
    const double error = std::max(cases[i].rmse, least_reported_error);
    const double time = *cases[i].time_ns;
    if (!(error < reached) || !(time > 0) || !(time < reference_time_ns)) continue;
    area += std::log(reference_time_ns / time) * std::log(reached / error);
    reached = error;
  }
  return area;
}

std::optional<FrontArea> front_area(std::span<const AccuracyCase> cases,
                                    std::span<const std::size_t> front, double reference_error) {
  if (front.empty()) return std::nullopt;
  const double least = std::max(cases[front.back()].rmse, least_reported_error);
  if (!(least < reference_error)) return std::nullopt;
  return FrontArea{hypervolume(cases, front, reference_error), std::log(reference_error / least)};
}

double equal_slowdown(const FrontArea& best, const FrontArea& other) {
  return std::exp((best.area - other.area) / best.width);
}

}  // namespace triptych::accuracy
