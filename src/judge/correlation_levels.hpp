#pragma once
// What a factor level adds to the line of two devices; part of the correlation model.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "judge/correlation_model.hpp"

namespace triptych::judge {

// Every level that holds enough of the configurations and leaves enough out, those that are slower
// than the rest before the others, each by the share of the residuals that they explain. `fit` is
// of the cases that are no anchors, in their order.
[[nodiscard]] std::vector<LevelEffect> level_effects(std::span<const CorrelationCase> cases,
                                                     const RobustLine& fit);

// The line beside an offset of the level that explains most of the residuals. `fit.residuals` are
// from the line of those inside or outside, whichever are more – of equally many the faster – and
// hold the offset.
struct LineBesideLevel {
  std::string name;  // "factor=level": what is slower
  RobustLine fit;
};
// nullopt where no level has enough inside and outside.
[[nodiscard]] std::optional<LineBesideLevel> line_beside_a_level(
    std::span<const CorrelationCase> cases, const RobustLine& fit);

// How many standard errors an effect must have to be found with the probability
// CorrelationModel::power as the only one among `tests` (Benjamini–Hochberg's first step).
[[nodiscard]] double detectable_in_errors(std::size_t tests, double degrees);

}  // namespace triptych::judge
