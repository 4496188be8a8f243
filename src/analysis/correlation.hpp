#pragma once
// How far the levels of a factor behave alike: Pearson's r between their times over the
// configurations that both have (the paper's Figures 4, 5, 11, 12, 13), and speed-ups by lines
// through the same pairs (Figures 6 and 7).

#include <optional>
#include <string>
#include <vector>

#include "analysis/splits.hpp"

namespace triptych::analysis {

// Fewer pairs say nothing: two points always lie on a line, and three nearly do by chance.
inline constexpr std::size_t least_pairs = 4;

struct LevelPair {
  std::string a, b;
  std::size_t pairs = 0;
  std::optional<double> r;  // absent for fewer than `least_pairs`, or where a level is constant
};

struct Matrix {
  std::string factor;
  std::vector<std::string> levels;
  std::vector<LevelPair> cells;  // every unordered pair once, a before b
  Scope scope;                   // observations that entered a pair
};
[[nodiscard]] Matrix correlations(const Split& split);

// One box of the overview: the r of a matrix.
struct Box {
  std::string factor;
  std::size_t levels = 0, cells = 0;  // cells with an r
  double mean = 0;
  record::Summary quartiles{};
  std::size_t samples = 0;
};
[[nodiscard]] std::optional<Box> box_of(const Matrix& matrix);  // absent without any r

// t_reference = intercept + speed_up · t_level by least squares through the pairs; the error is
// the paper's, (1 − r)·speed_up.
struct SpeedUp {
  std::string factor, level, reference;
  std::size_t pairs = 0;
  double speed_up = 0, error = 0, r = 0, intercept_ms = 0;
  // Geometric mean of t_reference / t_level over the same pairs: free of the intercept.
  double mean_ratio = 0;
  Scope scope;
};
// Of every level but the reference, as far as there are `least_pairs`. Empty when there is no such
// level as the reference.
[[nodiscard]] std::vector<SpeedUp> speed_ups(const Split& split, const std::string& reference);

// Correlation along a stack of the same data in several sizes: levels generate:NAME:SIZE of `data`.
struct Stack {
  std::string name;  // generate:NAME
  Matrix matrix;     // levels by size
  Box box;
};
[[nodiscard]] std::vector<Stack> stacks(const Dataset& dataset);

}  // namespace triptych::analysis
