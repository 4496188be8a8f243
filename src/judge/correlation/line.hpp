#pragma once
// Fits a robust line to one device's costs as a function of another device's costs, and finds the
// configurations that are off the line (docs/correlation.md).

#include <span>
#include <string>
#include <vector>

#include "judge/correlation/factor_levels.hpp"
#include "judge/correlation/pair.hpp"

namespace triptych::judge {

// Thresholds, which can be tuned with ci/bench. They were chosen on the basis of frame times,
// because at that time costs had not yet been measured on several devices.
struct LineModel {
  // Conditions under which a line is meaningful.
  static constexpr std::size_t least_configurations = 20;
  static constexpr double least_rho = 0.9;  // correlation of the logarithms
  static constexpr double least_slope = 0.7;
  static constexpr double largest_slope = 1.3;
  static constexpr double largest_scale = 0.25;
  // The scatter about a line is assumed to be at least this share of the cost, because repeated
  // measurements of the same cost may differ by this share.
  static constexpr double least_scale = 5e-4;
  // Conditions under which a factor level or a configuration is reported.
  // The expected share of false findings (Benjamini and Hochberg). It applies to levels and to
  // configurations separately, so the share is at most 1 % for both together.
  static constexpr double false_discovery_rate = 0.005;
  // The smallest effect of a configuration that is reported: 5 %. This is half of the effect that
  // must be found (10 %), because measured effects scatter around the true effect.
  static constexpr double configuration_effect = 1.05;
  static constexpr double level_effect = 1.015;  // the smallest effect of a level that is reported
  // A level is considered only if at least this many configurations have it and at least this many
  // do not have it.
  static constexpr std::size_t least_level = 4;
  // The maximum number of levels that are reported for one pair of devices.
  static constexpr std::size_t most_levels = 4;
};

// Fits a line to the points, which are logarithms of costs: points[i].y = a + b·points[i].x. Sets
// the line and the residuals. An MM-estimator refines the Theil-Sen line and a few other starting
// lines (estimation/regression.hpp).
void fit_line(CorrelationPair& pair);

struct LineOutlier {
  std::string level;                 // the factor level; empty for a single configuration
  std::vector<std::size_t> members;  // indices of points
  // The residual of the configuration, or the offset of the level relative to all other
  // configurations, as a natural logarithm.
  double effect = 0;
  double error = 0;  // standard error of the effect
  double q = 1;      // expected share of false findings among findings at least as significant
};

// Finds the levels and the configurations that are off the line. Call this only for a pair whose
// line was accepted. Returns the levels, the most significant first, and then the configurations
// that cost more than the line predicts, the largest residual first. Each level that is found gets
// its own offset in the model, and the line is fitted again before the search continues. `factors`
// contains the factors of each point.
[[nodiscard]] std::vector<LineOutlier> line_outliers(std::span<const CorrelationPoint> points,
                                                     std::span<const Factors> factors);

}  // namespace triptych::judge
