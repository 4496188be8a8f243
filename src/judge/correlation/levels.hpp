#pragma once
// What a factor level adds to the line of two devices; part of the correlation model.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "judge/correlation/model.hpp"

namespace triptych::judge {

// Every level that holds enough of the configurations and leaves enough out, those that are slower
// than the rest before the others, each by the share of the residuals that they explain. `fit` is
// of the cases that are no anchors, in their order; `offsets` of a line beside a level, else empty;
// `of_itself` as of correlate().
[[nodiscard]] std::vector<LevelEffect> level_effects(std::span<const CorrelationCase> cases,
                                                     const RobustLine& fit,
                                                     std::span<const double> offsets,
                                                     bool of_itself);

// The line beside an offset of the level whose effect is the most standard errors: of those inside
// or outside, whichever are more, of equally many the faster.
struct LineBesideLevel {
  std::string name;             // "factor=level"
  double offset = 0;            // of those inside against those outside, in ln t
  double p = 1;                 // of one as large by chance in any level
  RobustLine fit;               // residuals are without the offset
  std::vector<double> offsets;  // from that line, by configuration: 0 or ±offset
};
// nullopt where no level has enough inside and outside, and on an exact line.
[[nodiscard]] std::optional<LineBesideLevel> line_beside_a_level(
    std::span<const CorrelationCase> cases, const RobustLine& fit);

// Whether an effect, of p by chance in any level, is beyond chance and what devices differ by.
[[nodiscard]] bool is_level_told(double effect, double p);

// How many standard errors an effect must have to be found with the probability
// CorrelationModel::power as the only one among `tests` (Benjamini–Hochberg's first step).
[[nodiscard]] double detectable_in_errors(std::size_t tests, double degrees);

}  // namespace triptych::judge
