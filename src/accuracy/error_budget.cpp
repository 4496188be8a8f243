#include "accuracy/error_budget.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace triptych::accuracy {
namespace {

constexpr double steps_per_octave = 8;
// The first step was chosen so that its estimated error is about as large as requested. A step that
// is more than four times as long could meet the error only by chance.
constexpr int most_lengthening = 16;
constexpr int most_shortening_at_once = 32;
// If more than this share of the error remains with a shorter step, the step is not the reason why
// the error is too large.
constexpr double least_reduction = 0.95;

// Returns the number of grid steps by which the step size of a method of second order changes if
// its error changes by this factor.
double grid_steps(double factor) {
  return 0.5 * steps_per_octave * std::log2(factor);
}

}  // namespace

BudgetSearch::BudgetSearch(double error, double first_step, const StepLimits& limits,
                           std::vector<double> thresholds)
    : error_(error), first_step_(first_step), thresholds_(std::move(thresholds)) {
  const double down = steps_per_octave * std::log2(first_step / limits.shortest);
  const double up = steps_per_octave * std::log2(limits.longest / first_step);
  shortest_ = -static_cast<int>(std::max(std::floor(down), 0.0));
  longest_ = std::min(static_cast<int>(std::max(std::floor(up), 0.0)), most_lengthening);
}

double BudgetSearch::step_of(const BudgetPlace& place) const {
  return first_step_ * std::exp2(place.step / steps_per_octave);
}

double BudgetSearch::threshold_of(const BudgetPlace& place) const {
  return thresholds_.at(static_cast<std::size_t>(place.threshold));
}

void BudgetSearch::add(const BudgetPlace& place, const BudgetMeasurement& measured) {
  measured_.insert_or_assign(place, measured);
}

// Returns the number of samples at a place. If the place was not measured, the number is estimated
// from the nearest step that was measured with the same threshold. If samples were not counted,
// returns a number that depends only on the step.
double BudgetSearch::work_at(const BudgetPlace& place) const {
  const std::pair<const BudgetPlace, BudgetMeasurement>* nearest = nullptr;
  for (const auto& each : measured_) {
    if (each.first.threshold != place.threshold || !(each.second.samples > 0)) continue;
    const auto distance = [&](const auto& other) {
      return std::abs(other.first.step - place.step);
    };
    if (nearest == nullptr || distance(each) < distance(*nearest)) nearest = &each;
  }
  if (nearest == nullptr) return std::exp2(-place.step / steps_per_octave);
  return nearest->second.samples * std::exp2((nearest->first.step - place.step) / steps_per_octave);
}

std::optional<int> BudgetSearch::next_step(int threshold) const {
  using Tried = std::pair<int, double>;  // step and error
  std::optional<Tried> met;              // the longest step that meets the error
  std::vector<Tried> missed;             // longer steps that do not, in ascending order
  bool is_first = true;
  for (const auto& [place, measured] : measured_) {
    if (place.threshold != threshold) continue;
    is_first = false;
    if (!std::isfinite(measured.error)) return std::nullopt;
    if (meets(measured)) {
      met = {place.step, measured.error};
      missed.clear();
    } else {
      missed.emplace_back(place.step, measured.error);
    }
  }
  if (is_first) return 0;
  if (!met) {
    const auto& [step, error] = missed.front();
    const bool step_has_no_effect = missed.size() > 1 && error > least_reduction * missed[1].second;
    if (step == shortest_ || step_has_no_effect) return std::nullopt;
    const int shortening = static_cast<int>(
        std::clamp(std::ceil(grid_steps(error / error_)), 1.0, double{most_shortening_at_once}));
    return std::max(step - shortening, shortest_);
  }
  const auto& [step, error] = *met;
  if (missed.empty()) {
    const double lengthening =
        error > 0 ? std::floor(grid_steps(error_ / error)) : double{most_lengthening};
    if (step == longest_ || lengthening < 1) return std::nullopt;
    return std::min(step + static_cast<int>(std::min(lengthening, steps_per_octave)), longest_);
  }
  const auto& [too_long, too_large] = missed.front();
  if (too_long - step <= 1) return std::nullopt;
  // Interpolates between the logarithms of the errors.
  const double share = error > 0 ? std::log(error_ / error) / std::log(too_large / error) : 0.5;
  return std::clamp(step + static_cast<int>(share * (too_long - step)), step + 1, too_long - 1);
}

std::vector<BudgetPlace> BudgetSearch::next() {
  std::vector<BudgetPlace> places;
  if (rounds_ == most_rounds) return places;
  ++rounds_;
  const std::optional<BudgetPlace> best = cheapest();
  for (int i = 0; i < static_cast<int>(thresholds_.size()); ++i) {
    const std::optional<int> step = next_step(i);
    if (!step) continue;
    // A place that would not save samples is not worth a measurement.
    const BudgetPlace place{*step, i};
    if (!best || work_at(place) < work_at(*best)) places.push_back(place);
  }
  return places;
}

std::optional<BudgetPlace> BudgetSearch::cheapest() const {
  std::optional<BudgetPlace> best;
  const auto rank = [&](const BudgetPlace& place) {
    return std::tuple(work_at(place), -place.step, -place.threshold);
  };
  for (const auto& [place, measured] : measured_) {
    if (meets(measured) && (!best || rank(place) < rank(*best))) best = place;
  }
  return best;
}

std::optional<BudgetPlace> BudgetSearch::nearest() const {
  std::optional<BudgetPlace> nearest;
  for (const auto& [place, measured] : measured_) {
    if (!std::isfinite(measured.error)) continue;
    if (!nearest || measured.error < measured_.at(*nearest).error) nearest = place;
  }
  return nearest;
}

}  // namespace triptych::accuracy
