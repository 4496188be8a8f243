#pragma once
// How well times are predicted (section 5.3 of the paper): one linear regression per data structure
// against one random forest over everything, on a seeded split.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/splits.hpp"

namespace triptych::analysis {

struct Score {
  std::string data;               // a level of `data`, or "all"
  std::size_t models = 0;         // linear models, one per structure
  std::size_t held_out = 0;       // observations both are scored on
  std::optional<double> line_r2;  // absent where the times are constant
  std::optional<double> forest_r2;
};

struct Prediction {
  std::vector<std::string> line_features;  // "device (category)", "viewport (pixels)", …
  std::vector<std::string> structure;      // factors that vary and part the linear models
  std::size_t trained = 0, held_out = 0;   // observations of the split
  std::size_t structures = 0;              // that there are
  std::size_t structures_left_out = 0;     // with fewer training rows than unknowns + 2
  std::vector<Score> scores;               // by data set, then "all"
  // The mean, least and largest R² of the lines over data sets, as the paper reports them.
  std::optional<double> line_mean, line_least, line_largest;
  std::optional<double> forest_on_all;  // of the forest on every held-out observation
  Scope scope;
};

inline constexpr double train_share = 0.7;
inline constexpr std::size_t least_for_prediction = 40;

// Structure, as in the paper: data, transfer function, acceleration and camera, and for particles
// what else changes the scene. Features of the lines are the remaining factors: viewport as its
// pixels, step as samples per voxel (time follows both linearly), categories as indicators. The
// forest is given all factors. Absent, with the reason, where there is too little to learn from.
struct PredictionOutcome {
  std::optional<Prediction> prediction;
  std::string reason;
};
[[nodiscard]] PredictionOutcome predict(const Dataset& dataset, std::uint64_t seed);

}  // namespace triptych::analysis
