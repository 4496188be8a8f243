#include "judge/correlation/line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/regression.hpp"
#include "estimation/statistics.hpp"
#include "record/names.hpp"

namespace triptych::judge {
namespace {

using Model = LineModel;
using Values = std::vector<double>;

struct Coordinates {
  Values x;
  Values y;
};

Coordinates coordinates_of(std::span<const CorrelationPoint> points) {
  Coordinates all;
  for (const CorrelationPoint& point : points) {
    all.x.push_back(point.x);
    all.y.push_back(point.y);
  }
  return all;
}

bool can_have_line(const Values& x) {
  return x.size() >= 4 && std::ranges::any_of(x, [&](double each) { return each != x.front(); });
}

// Returns exp(x − first) for each logarithm x, where first is the first logarithm. The subtraction
// prevents an overflow. It does not change the correlation r, because r does not depend on units.
Values exponentials(Values logarithms) {
  const double first = logarithms.front();
  for (double& value : logarithms) value = std::exp(value - first);
  return logarithms;
}

// Returns why the fitted line must not be used, or LineRefusal::none. The comparisons are written
// so that a line with NaN is refused, too.
LineRefusal refusal_of(const CorrelationLine& line) {
  if (line.configurations < Model::least_configurations) {
    return LineRefusal::too_few_configurations;
  }
  if (!(line.rho >= Model::least_rho)) return LineRefusal::low_correlation;
  if (!(line.slope >= Model::least_slope && line.slope <= Model::largest_slope)) {
    return LineRefusal::slope_out_of_range;
  }
  return line.scale <= Model::largest_scale ? LineRefusal::none : LineRefusal::large_scatter;
}

constexpr record::Names<LineRefusal, 5> refusal_names{{
    {LineRefusal::none, "none"},
    {LineRefusal::too_few_configurations, "too_few_configurations"},
    {LineRefusal::low_correlation, "low_correlation"},
    {LineRefusal::slope_out_of_range, "slope_out_of_range"},
    {LineRefusal::large_scatter, "large_scatter"},
}};

double two_sided(double z, double degrees) {
  return 2 * estimation::student_t_upper_tail(std::abs(z), degrees);
}

estimation::RobustLine fit_of(const Values& x, const Values& y) {
  estimation::RobustLine fit = estimation::robust_line(x, y);
  fit.scale = std::max(fit.scale, Model::least_scale);
  return fit;
}

// Sets the weights of the configurations whose indices are in `side`: all configurations with a
// factor level, or all configurations without it. Each weight depends on the deviation of a
// residual from the median residual of `side`; these deviations are returned in `centred`.
// Therefore, if a level shifts the residuals of all its configurations, these configurations do not
// count as outliers.
void weigh_side(const Values& residuals, const std::vector<std::size_t>& side, double scale,
                Values& weights, Values& centred) {
  Values values;
  for (const std::size_t i : side) values.push_back(residuals[i]);
  const double centre = estimation::median(values);
  for (const std::size_t i : side) {
    centred[i] = residuals[i] - centre;
    weights[i] = estimation::bisquare_weight(centred[i], scale);
  }
}

// Returns Σw·(a − ā)·(b − b̄), where ā and b̄ are the weighted means.
double weighted_product(const Values& weights, const Values& a, const Values& b) {
  double sum = 0;
  double sum_a = 0;
  double sum_b = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    sum_a += weights[i] * a[i];
    sum_b += weights[i] * b[i];
  }
  double product = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    product += weights[i] * (a[i] - sum_a / sum) * (b[i] - sum_b / sum);
  }
  return product;
}

// Computes the effect g of a factor level in the model y = a + b·x + g·d. Here x and y are the
// logarithms of a configuration's costs on the two devices, and d is 1 if the configuration has the
// level, otherwise 0. First removes the regression of d on x (Frisch and Waugh 1933), because
// otherwise b would absorb a part of the effect if all configurations with the level are expensive.
LineOutlier level_effect(const Values& x, const estimation::RobustLine& fit,
                         const FactorLevel& level) {
  Values weights(x.size());
  Values centred(x.size());
  weigh_side(fit.residuals, level.inside, fit.scale, weights, centred);
  weigh_side(fit.residuals, level.outside, fit.scale, weights, centred);
  Values indicator(x.size(), 0.0);
  for (const std::size_t i : level.inside) indicator[i] = 1;
  const double projection =
      weighted_product(weights, x, indicator) / weighted_product(weights, x, x);
  Values orthogonal(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) orthogonal[i] = indicator[i] - projection * x[i];
  const double squares = weighted_product(weights, orthogonal, orthogonal);
  LineOutlier result{level.name, level.inside, 0, 0, 1};
  result.effect = weighted_product(weights, orthogonal, fit.residuals) / squares;
  const double kappa = estimation::robust_variance(centred, fit.scale, 3);
  result.error = fit.scale * std::sqrt(kappa / squares);
  return result;
}

// Returns the level with the most significant effect, together with the q-value of that effect. If
// there is no level, the effect is 0.
LineOutlier most_significant_level(const Values& x, const estimation::RobustLine& fit,
                                   std::span<const FactorLevel> levels) {
  LineOutlier best;
  Values p;
  double least = 2;
  for (const FactorLevel& level : levels) {
    const LineOutlier each = level_effect(x, fit, level);
    // The effect is NaN if the level's indicator is a linear function of x, or if all points of the
    // level have weight 0.
    if (!std::isfinite(each.effect) || !(each.error > 0)) continue;
    p.push_back(two_sided(each.effect / each.error, static_cast<double>(x.size()) - 3));
    if (p.back() >= least) continue;
    least = p.back();
    best = each;
  }
  if (!p.empty()) best.q = std::ranges::min(estimation::benjamini_hochberg_adjusted(p));
  return best;
}

std::vector<LineOutlier> outlying_configurations(const Values& x,
                                                 const estimation::RobustLine& fit) {
  std::vector<LineOutlier> all;
  Values p;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double error = fit.scale * std::sqrt(1 + fit.leverages[i]);
    all.push_back({{}, {i}, fit.residuals[i], error, 1});
    p.push_back(estimation::student_t_upper_tail(fit.residuals[i] / error,
                                                 static_cast<double>(x.size()) - 2));
  }
  const Values q = estimation::benjamini_hochberg_adjusted(p);
  for (std::size_t i = 0; i < x.size(); ++i) all[i].q = q[i];
  std::erase_if(all, [](const LineOutlier& each) {
    return each.q > Model::false_discovery_rate ||
           each.effect < std::log(Model::configuration_effect);
  });
  std::ranges::stable_sort(all, std::greater{}, &LineOutlier::effect);
  return all;
}

}  // namespace

std::string_view name_of(LineRefusal refusal) {
  return record::name_in(refusal_names, refusal);
}

void fit_line(CorrelationPair& pair) {
  CorrelationLine& line = pair.line;
  line.configurations = pair.points.size();
  const auto [x, y] = coordinates_of(pair.points);
  if (!can_have_line(x)) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    line.intercept = line.slope = line.scale = line.rho = line.pearson = none;
    for (CorrelationPoint& point : pair.points) point.residual = none;
  } else {
    const estimation::RobustLine fit = estimation::robust_line(x, y);
    line.intercept = fit.line.intercept;
    line.slope = fit.line.slope;
    line.scale = fit.scale;
    line.rho = estimation::pearson_r(x, y);
    line.pearson = estimation::pearson_r(exponentials(x), exponentials(y));
    for (CorrelationPoint& point : pair.points) point.residual = point.y - line.at(point.x);
  }
  line.refusal = refusal_of(line);
}

std::vector<LineOutlier> line_outliers(std::span<const CorrelationPoint> points,
                                       std::span<const Factors> factors) {
  auto [x, y] = coordinates_of(points);
  const std::vector<FactorLevel> levels = factor_levels(factors, Model::least_level);
  std::vector<LineOutlier> result;
  estimation::RobustLine fit = fit_of(x, y);
  while (result.size() < Model::most_levels) {
    LineOutlier level = most_significant_level(x, fit, levels);
    if (level.q > Model::false_discovery_rate ||
        std::abs(level.effect) < std::log(Model::level_effect)) {
      break;
    }
    for (const std::size_t i : level.members) y[i] -= level.effect;
    fit = fit_of(x, y);
    result.push_back(std::move(level));
  }
  std::ranges::move(outlying_configurations(x, fit), std::back_inserter(result));
  return result;
}

}  // namespace triptych::judge
