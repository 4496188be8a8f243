#pragma once
// The robust line of one device's cost along another's, and what lies off it. docs/correlation.md
// says what it is good for.

#include <span>
#include <string>
#include <vector>

#include "judge/correlation/factor_levels.hpp"
#include "judge/correlation/pair.hpp"

namespace triptych::judge {

// First guesses, from times: real costs of several devices were not there when these were set. Tune
// them by the bench.
struct LineModel {
  // Which lines can tell something.
  static constexpr std::size_t least_configurations = 20;
  static constexpr double least_rho = 0.9;  // of logarithms
  static constexpr double least_slope = 0.7;
  static constexpr double largest_slope = 1.3;
  static constexpr double largest_scale = 0.25;
  // Costs repeat by so much: a line cannot be known better.
  static constexpr double least_scale = 5e-4;
  // What is named.
  // Expected, by Benjamini and Hochberg, of levels and of configurations; 1 % of both together.
  static constexpr double share_of_false = 0.005;
  // Half of what is to be found (10 %): what lies there scatters about it.
  static constexpr double configuration_effect = 1.05;
  static constexpr double level_effect = 1.015;  // at least, as measured
  static constexpr std::size_t least_level = 4;  // configurations inside and outside
  static constexpr std::size_t most_levels = 4;  // named of one pair
};

// Fits points[i].y along points[i].x and sets their residuals. ln y = a + b·ln x: Theil and Sen's
// line and others to start, refined by an MM-estimate (estimation/regression.hpp).
void fit_line(CorrelationPair& pair);

struct OffTheLine {
  std::string level;                 // empty: one configuration
  std::vector<std::size_t> members;  // points
  double effect = 0;                 // ln: of the residual, or of the level against the rest
  double error = 0;                  // its standard error
  double q = 1;                      // expected share of false ones among those as clear as this
};

// Of a pair whose line is admitted: levels, the clearest first, then configurations that cost more
// than it lets expect, the farthest first. A level that is told gets an offset of its own, and
// everything else is held against the line beside it. `factors`: of each point.
[[nodiscard]] std::vector<OffTheLine> off_the_line(std::span<const CorrelationPoint> points,
                                                   std::span<const Factors> factors);

}  // namespace triptych::judge
