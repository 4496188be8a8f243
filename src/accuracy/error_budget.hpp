#pragma once
// Finds the step size and the threshold of early ray termination that together use up a requested
// error, by measuring the error of complete images.

#include <compare>
#include <map>
#include <optional>
#include <vector>

#include "accuracy/choice.hpp"

namespace triptych::accuracy {

// A place in the grid of settings that BudgetSearch searches.
struct BudgetPlace {
  int step = 0;       // the step is 2^(step/8) times the first step
  int threshold = 0;  // index of the threshold of early ray termination
  auto operator<=>(const BudgetPlace&) const = default;
};

struct BudgetMeasurement {
  double error = 0;    // of the complete image; NaN if the settings could not be drawn
  double samples = 0;  // number of samples that were taken; 0 if they were not counted
};

// The errors of a long step and of early termination do not simply add up: independent errors add
// up like the sides of a right triangle, and errors with opposite signs cancel. Therefore, this
// search does not divide the requested error between the two sources. It measures the total error,
// and looks for the settings with the fewest samples whose total error is at most the requested
// error. The steps form a grid with a ratio of 2^(1/8), and the search assumes that the error is of
// second order. Therefore the longest possible step may be up to 9 % longer than the result, or up
// to 19 % longer if the error is only of first order. The search depends only on errors and on
// sample counts, not on times, so it always ends with the same result.
class BudgetSearch {
 public:
  // The search begins with the step `first_step`. `thresholds` are in ascending order.
  BudgetSearch(double error, double first_step, const StepLimits& limits,
               std::vector<double> thresholds);

  // Returns the places to be measured next, at most one for each threshold. The search has ended if
  // there are none, which is the case after `most_rounds` calls at the latest.
  [[nodiscard]] std::vector<BudgetPlace> next();
  void add(const BudgetPlace& place, const BudgetMeasurement& measured);
  [[nodiscard]] bool has(const BudgetPlace& place) const { return measured_.contains(place); }

  [[nodiscard]] double step_of(const BudgetPlace& place) const;
  [[nodiscard]] double threshold_of(const BudgetPlace& place) const;

  // cheapest() returns the place with the fewest samples among those that meet the error. nearest()
  // returns the place with the smallest error. They return nullopt if there is no such place.
  [[nodiscard]] std::optional<BudgetPlace> cheapest() const;
  [[nodiscard]] std::optional<BudgetPlace> nearest() const;

  static constexpr int most_rounds = 6;

 private:
  [[nodiscard]] bool meets(const BudgetMeasurement& measured) const {
    return measured.error <= error_;
  }
  [[nodiscard]] double work_at(const BudgetPlace& place) const;
  [[nodiscard]] std::optional<int> next_step(int threshold) const;

  double error_;
  double first_step_;
  int shortest_;  // smallest and largest value of BudgetPlace::step
  int longest_;
  std::vector<double> thresholds_;
  std::map<BudgetPlace, BudgetMeasurement> measured_;
  int rounds_ = 0;
};

}  // namespace triptych::accuracy
