#include "analysis/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "estimation/regression.hpp"
#include "estimation/statistics.hpp"

namespace triptych::analysis {

using estimation::least_squares;
using estimation::LeastSquares;
using estimation::mean;
using estimation::pearson_r;
namespace {

struct Pairs {
  std::vector<double> a, b;  // ms
  Chosen chosen;             // those of a, then those of b
};

Pairs pairs_of(const Level& a, const Level& b) {
  Pairs pairs;
  Chosen of_b;
  for (const auto& [key, observation] : a.by_key) {
    const auto other = b.by_key.find(key);
    if (other == b.by_key.end()) continue;
    pairs.a.push_back(observation->ms);
    pairs.b.push_back(other->second->ms);
    pairs.chosen.push_back(observation);
    of_b.push_back(other->second);
  }
  pairs.chosen.insert(pairs.chosen.end(), of_b.begin(), of_b.end());
  return pairs;
}

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

double geometric_mean_ratio(const std::vector<double>& above, const std::vector<double>& below) {
  double sum = 0;
  for (std::size_t i = 0; i < above.size(); ++i) sum += std::log(above[i] / below[i]);
  return std::exp(sum / static_cast<double>(above.size()));
}

}  // namespace

Matrix correlations(const Split& split) {
  Matrix matrix{.factor = split.factor};
  std::set<const Observation*> entered;
  for (std::size_t i = 0; i < split.levels.size(); ++i) {
    matrix.levels.push_back(split.levels[i].name);
    for (std::size_t j = i + 1; j < split.levels.size(); ++j) {
      const Pairs pairs = pairs_of(split.levels[i], split.levels[j]);
      LevelPair cell{split.levels[i].name, split.levels[j].name, pairs.a.size(), std::nullopt};
      if (cell.pairs >= least_pairs) cell.r = finite(pearson_r(pairs.a, pairs.b));
      if (cell.r) entered.insert(pairs.chosen.begin(), pairs.chosen.end());
      matrix.cells.push_back(std::move(cell));
    }
  }
  matrix.scope = scope_of(Chosen(entered.begin(), entered.end()));
  return matrix;
}

std::optional<Box> box_of(const Matrix& matrix) {
  std::vector<double> values;
  for (const LevelPair& cell : matrix.cells) {
    if (cell.r) values.push_back(*cell.r);
  }
  const auto quartiles = record::summarise(values);
  if (!quartiles) return std::nullopt;
  return Box{.factor = matrix.factor,
             .levels = matrix.levels.size(),
             .cells = values.size(),
             .mean = mean(values),
             .quartiles = *quartiles,
             .samples = matrix.scope.samples};
}

std::vector<SpeedUp> speed_ups(const Split& split, const std::string& reference) {
  const auto base = std::ranges::find(split.levels, reference, &Level::name);
  if (base == split.levels.end()) return {};
  std::vector<SpeedUp> result;
  for (const Level& level : split.levels) {
    if (level.name == reference) continue;
    const Pairs pairs = pairs_of(level, *base);
    if (pairs.a.size() < least_pairs) continue;
    // A line wants times that differ.
    if (!std::isfinite(pearson_r(pairs.a, pairs.b))) continue;
    const LeastSquares fit = least_squares(pairs.a, pairs.b);
    result.push_back({.factor = split.factor,
                      .level = level.name,
                      .reference = reference,
                      .pairs = pairs.a.size(),
                      .speed_up = fit.line.slope,
                      .error = (1 - fit.r) * fit.line.slope,
                      .r = fit.r,
                      .intercept_ms = fit.line.intercept,
                      .mean_ratio = geometric_mean_ratio(pairs.b, pairs.a),
                      .scope = scope_of(pairs.chosen)});
  }
  return result;
}

std::vector<Stack> stacks(const Dataset& dataset) {
  std::map<std::string, Split> by_name;
  for (Level& level : split(dataset, "data").levels) {
    const std::size_t colon = level.name.rfind(':');
    if (!level.name.starts_with("generate:") || colon <= std::string("generate").size()) continue;
    Split& of_name = by_name[level.name.substr(0, colon)];
    of_name.factor = "data";
    of_name.levels.push_back(std::move(level));
  }
  std::vector<Stack> result;
  for (const auto& [name, of_name] : by_name) {
    Matrix matrix = correlations(of_name);
    const auto box = box_of(matrix);
    if (box) result.push_back({name, std::move(matrix), *box});
  }
  return result;
}

}  // namespace triptych::analysis
