#pragma once
// Fits a robust line to one device's cost as a function of another's, and finds the configurations
// that are off the line. docs/correlation.md explains its use.

#include <span>
#include <string>
#include <vector>

#include "judge/correlation/factor_levels.hpp"
#include "judge/correlation/pair.hpp"

namespace triptych::judge {

// Initial values. They were chosen from times, because costs of several devices were not available
// then. Tune them with ci/bench.
struct LineModel {
  // Conditions under which a line is meaningful.
  static constexpr std::size_t least_configurations = 20;
  static constexpr double least_rho = 0.9;  // of the logarithms
  static constexpr double least_slope = 0.7;
  static constexpr double largest_slope = 1.3;
  static constexpr double largest_scale = 0.25;
  // Costs repeat only within this share, so the scatter about a line is never assumed to be
  // smaller.
  static constexpr double least_scale = 5e-4;
  // Conditions under which a level or a configuration is reported. The expected share of false
  // findings (Benjamini and Hochberg), for levels and for configurations separately; it is 1 % for
  // both together.
  static constexpr double share_of_false = 0.005;
  // Half of the effect that must be found (10 %), because measured effects scatter around the true
  // one.
  static constexpr double configuration_effect = 1.05;
  static constexpr double level_effect = 1.015;  // the smallest effect that is reported
  static constexpr std::size_t least_level = 4;  // this many configurations inside, and outside
  static constexpr std::size_t most_levels = 4;  // that are named for one pair of devices
};

// Fits points[i].y as a function of points[i].x and sets the residuals. The model is
// ln y = a + b·ln x. The line of Theil and Sen and some others are starting points, which an
// MM-estimate refines (estimation/regression.hpp).
void fit_line(CorrelationPair& pair);

struct OffTheLine {
  std::string level;                 // empty: one configuration
  std::vector<std::size_t> members;  // indices of points
  double effect = 0;                 // ln: the residual, or the level minus the rest
  double error = 0;                  // its standard error
  double q = 1;  // expected share of false findings among all at least as significant
};

// For a pair whose line is accepted: first levels, beginning with the clearest, then configurations
// that cost more than the line predicts, beginning with the largest residual. A reported level gets
// its own offset in the model, and the line is fitted again before the search goes on. `factors`:
// those of each point.
[[nodiscard]] std::vector<OffTheLine> off_the_line(std::span<const CorrelationPoint> points,
                                                   std::span<const Factors> factors);

}  // namespace triptych::judge
