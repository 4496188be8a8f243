#pragma once
// Mean time by the levels of two factors: the paper's heat maps (Figures 8 and 14).

#include <string>
#include <vector>

#include "analysis/splits.hpp"

namespace triptych::analysis {

struct MeanCell {
  std::string row, column;
  std::size_t samples = 0;
  double mean_ms = 0;
};

struct MeanTimes {
  std::string rows, columns;    // factors
  std::vector<MeanCell> cells;  // a combination that nothing measured has none
  Scope scope;
};

// Over the fullest block, so that cells differ in their two factors alone. Empty cells when either
// factor has fewer than two levels there.
[[nodiscard]] MeanTimes mean_times(const Dataset& dataset, std::string_view rows,
                                   std::string_view columns);

}  // namespace triptych::analysis
