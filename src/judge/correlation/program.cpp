#include "judge/correlation/program.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "judge/statistics/statistics.hpp"

namespace triptych::judge {
namespace {

using Model = CorrelationModel;

double square(double value) {
  return value * value;
}

struct Weighted {
  double sum = 0;  // of the weights
  double centre = 0;
  double deviation = 0;  // Σw(y − ȳ)²
};

Weighted weigh(std::span<const KnownEffect> effects, double variance) {
  Weighted result;
  for (const KnownEffect& each : effects) {
    const double weight = 1 / (variance + each.variance);
    result.sum += weight;
    result.centre += weight * each.value;
  }
  result.centre /= result.sum;
  for (const KnownEffect& each : effects) {
    result.deviation += square(each.value - result.centre) / (variance + each.variance);
  }
  return result;
}

// The mean of y − βx by technique, or of each anchor where all have one technique, with the
// variance of its times.
std::vector<KnownEffect> anchor_groups(std::span<const CorrelationCase> cases, double slope) {
  std::map<std::string, std::vector<KnownEffect>> by_technique;
  std::vector<KnownEffect> single;
  for (const CorrelationCase& each : cases) {
    if (!each.anchor) continue;
    const auto technique = each.factors.find("technique");
    single.push_back(
        {each.log_time_b - slope * each.log_time_a, each.variance_a + each.variance_b});
    by_technique[technique == each.factors.end() ? each.configuration : technique->second]
        .push_back(single.back());
  }
  if (by_technique.size() < 2) return single;
  std::vector<KnownEffect> means;
  for (const auto& [technique, members] : by_technique) {
    const auto count = static_cast<double>(members.size());
    KnownEffect& group = means.emplace_back();
    for (const KnownEffect& each : members) {
      group.value += each.value / count;
      group.variance += each.variance / square(count);
    }
  }
  return means;
}

// Of each, only what its variance is beyond what is typical, which their scatter holds already.
void leave_excess(std::vector<KnownEffect>& groups) {
  std::vector<double> variances;
  for (const KnownEffect& each : groups) variances.push_back(each.variance);
  const double typical = median(variances);
  for (KnownEffect& each : groups) each.variance = std::max(each.variance - typical, 0.0);
}

double mean_log_time_of_anchors(std::span<const CorrelationCase> cases) {
  std::vector<double> times;
  for (const CorrelationCase& each : cases) {
    if (each.anchor) times.push_back(each.log_time_a);
  }
  return mean(times);
}

// Of ln t since B was accepted, ascending.
std::vector<double> changes_of(std::span<const CorrelationCase> cases, bool of_anchors) {
  std::vector<double> changes;
  for (const CorrelationCase& each : cases) {
    if (each.anchor != of_anchors || !each.known_log_time_b) continue;
    changes.push_back(each.log_time_b - *each.known_log_time_b);
  }
  std::ranges::sort(changes);
  return changes;
}

struct Changes {
  std::vector<double> program;
  std::vector<double> anchors;
  [[nodiscard]] bool known() const {
    return anchors.size() >= Model::least_anchors && program.size() >= Model::least_configurations;
  }
  // Of three quarters of the program at least.
  [[nodiscard]] double beyond_anchors() const {
    const double rank = Model::share_not_slower * static_cast<double>(program.size() - 1);
    return program[static_cast<std::size_t>(rank)] - median(anchors);
  }
};

// p and what goes with it, from Δ, its error and its degrees.
void decide(double least_effect, GlobalShift& global) {
  const double least = std::log(least_effect);
  global.p = student_t_upper_tail(global.delta / global.standard_error, global.degrees);
  global.smallest_effect =
      std::max(least, global.standard_error *
                          (student_t_upper_quantile(Model::false_global_alarms, global.degrees) +
                           student_t_upper_quantile(1 - Model::power, global.degrees)));
  global.slower = global.p <= Model::false_global_alarms && global.delta >= least;
  global.suspected = global.p <= Model::false_global_suspects && global.delta >= least;
}

void judge_since_acceptance(const Changes& changes, const KnownVariance& beside_anchors,
                            GlobalShift& global) {
  const std::vector<double>& anchors = changes.anchors;
  global.since_acceptance = true;
  global.groups = anchors.size();
  global.delta = changes.beyond_anchors();
  const double of_anchors =
      variance_of_median_to_mean * robust_variance(anchors) / static_cast<double>(anchors.size()) +
      least_timing_variance;
  const KnownVariance whole =
      KnownVariance{of_anchors, robust_degrees(anchors.size())} +
      KnownVariance{variance_of_quantile(changes.program, Model::share_not_slower)} +
      beside_anchors;
  global.standard_error = std::sqrt(whole.variance);
  global.degrees = whole.degrees;
  decide(Model::least_change, global);
}

}  // namespace

std::optional<double> change_since_acceptance(std::span<const CorrelationCase> cases,
                                              bool of_anchors) {
  const std::vector<double> changes = changes_of(cases, of_anchors);
  if (changes.empty()) return std::nullopt;
  return median(changes);
}

RandomEffects random_effects(std::span<const KnownEffect> effects) {
  std::vector<double> values;
  for (const KnownEffect& each : effects) values.push_back(each.value);
  const double expected = static_cast<double>(effects.size()) - 1;
  const auto excess = [&](double variance) {
    return weigh(effects, variance).deviation - expected;
  };
  RandomEffects result;
  result.variance = least_timing_variance;
  if (excess(least_timing_variance) > 0) {
    // Above the variance of all, whatever is known of each, nothing is left to explain.
    const double most = sample_variance(values) + least_timing_variance;
    std::uintmax_t steps = 200;
    const auto bracket = boost::math::tools::toms748_solve(
        excess, least_timing_variance, most, boost::math::tools::eps_tolerance<double>(40), steps);
    result.variance = std::midpoint(bracket.first, bracket.second);
  }
  const Weighted weighted = weigh(effects, result.variance);
  result.centre = weighted.centre;
  result.centre_variance = 1 / weighted.sum;
  result.degrees = std::max(result.variance * weighted.sum - 1, 1.0);
  return result;
}

void judge_program(std::span<const CorrelationCase> cases, const RobustLine& fit,
                   const KnownVariance& beside_anchors, Correlation& result) {
  GlobalShift& global = result.global;
  std::vector<KnownEffect> groups = anchor_groups(cases, fit.line.slope);
  if (groups.size() < 2) return;
  leave_excess(groups);
  const RandomEffects anchors = random_effects(groups);
  result.anchor_intercept = anchors.centre;
  const Changes changes{changes_of(cases, false), changes_of(cases, true)};
  if (changes.known() && beside_anchors.degrees > 0) {
    judge_since_acceptance(changes, beside_anchors, global);
    return;
  }
  // α − α′ = (ȳ − βx̄) − (ȳ′ − βx̄′): the slope's error moves both, all but for the distance of
  // their centres: var α + 2x̄′ cov(α, β) + x̄′² var β.
  const double centre = mean_log_time_of_anchors(cases);
  const double of_line = square(fit.intercept_error) + 2 * centre * fit.slope_intercept_covariance +
                         square(centre * fit.slope_error);
  global.groups = groups.size();
  global.delta = fit.line.intercept - result.anchor_intercept;
  global.degrees = anchors.degrees;
  global.standard_error =
      std::sqrt(anchors.variance + anchors.centre_variance + std::max(of_line, 0.0));
  decide(Model::least_effect, global);
  // What stood when B was accepted is its character.
  if (changes.known() && !Model::is_worth_telling(changes.beyond_anchors())) {
    global.slower = global.suspected = false;
  }
}

}  // namespace triptych::judge
