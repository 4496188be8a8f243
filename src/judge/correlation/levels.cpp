#include "judge/correlation/levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <ranges>
#include <string>
#include <utility>

#include "judge/statistics/statistics.hpp"

namespace triptych::judge {
namespace {

using Model = CorrelationModel;
constexpr std::size_t parameters = 3;  // α, β and the level

// A level and who is in it.
struct Group {
  LevelEffect named;
  std::vector<bool> inside;
};

std::vector<const CorrelationCase*> configurations_of(std::span<const CorrelationCase> cases) {
  std::vector<const CorrelationCase*> result;
  for (const CorrelationCase& each : cases) {
    if (!each.anchor) result.push_back(&each);
  }
  return result;
}

std::vector<double> values_of(const std::vector<const CorrelationCase*>& cases,
                              double CorrelationCase::*member) {
  std::vector<double> values;
  for (const CorrelationCase* each : cases) values.push_back(each->*member);
  return values;
}

// Levels with the same configurations are one group under several names.
std::vector<Group> groups_of(const std::vector<const CorrelationCase*>& cases) {
  std::map<std::pair<std::string, std::string>, std::vector<bool>> levels;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const auto& level : cases[i]->factors) {
      auto [known, added] = levels.try_emplace(level, std::vector<bool>(cases.size(), false));
      known->second[i] = true;
    }
  }
  std::vector<Group> groups;
  for (const auto& [level, inside] : levels) {
    const auto size = static_cast<std::size_t>(std::ranges::count(inside, true));
    if (size < Model::least_level || cases.size() - size < Model::least_level) continue;
    const auto same =
        std::ranges::find_if(groups, [&](const Group& group) { return group.inside == inside; });
    if (same != groups.end()) {
      same->named.aliases.push_back(level.first + "=" + level.second);
      continue;
    }
    Group group;
    group.named.factor = level.first;
    group.named.level = level.second;
    group.named.size = size;
    group.inside = inside;
    groups.push_back(std::move(group));
  }
  return groups;
}

// The lower median, one of the values: halfway between two clusters (one of two levels beside this
// one is slower) everything would be wild.
double median_where(const std::vector<double>& values, const std::vector<bool>& inside, bool side) {
  std::vector<double> chosen;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (inside[i] == side) chosen.push_back(values[i]);
  }
  const auto middle = chosen.begin() + static_cast<std::ptrdiff_t>((chosen.size() - 1) / 2);
  std::ranges::nth_element(chosen, middle);
  return *middle;
}

// Sums of a regression of r on 1, x and the indicator d, by d with its regression on 1 and x taken
// out (Frisch & Waugh 1933): the effect is Σw·d̃·r/Σw·d̃².
struct Contrast {
  double effect = 0;
  double information = 0;  // Σw·d̃²/mean w
};

Contrast contrast(const std::vector<double>& x, const std::vector<double>& r,
                  const std::vector<bool>& inside, const std::vector<double>& weights) {
  double w = 0;
  double wx = 0;
  double wd = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    w += weights[i];
    wx += weights[i] * x[i];
    wd += inside[i] ? weights[i] : 0;
  }
  const double x_mean = wx / w;
  const double d_mean = wd / w;
  double xx = 0;
  double xd = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += weights[i] * (x[i] - x_mean) * (x[i] - x_mean);
    xd += weights[i] * (x[i] - x_mean) * (inside[i] ? 1 - d_mean : -d_mean);
  }
  const double slope = xx > 0 ? xd / xx : 0;
  double product = 0;
  double square = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double rest = (inside[i] ? 1 - d_mean : -d_mean) - slope * (x[i] - x_mean);
    product += weights[i] * rest * r[i];
    square += weights[i] * rest * rest;
  }
  return {product / square, square / (w / static_cast<double>(x.size()))};
}

// Share of the residuals' sum of squares, wild ones and all, that the indicator explains.
double explained_share(const std::vector<double>& r, const Group& group) {
  const double centre = mean(r);
  double total = 0;
  double within = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    total += (r[i] - centre) * (r[i] - centre);
    within += group.inside[i] ? r[i] - centre : 0;
  }
  const auto size = static_cast<double>(group.named.size);
  const auto rest = static_cast<double>(r.size()) - size;
  return total > 0 ? within * within * (1 / size + 1 / rest) / total : 0;
}

// Of so many configurations. On an exact line any effect is beyond chance.
double p_of_slower(const LevelEffect& level, std::size_t configurations) {
  if (!(level.standard_error > 0)) return level.effect > 0 ? 0 : 1;
  return student_t_upper_tail(level.effect / level.standard_error,
                              static_cast<double>(configurations - parameters));
}

// From residuals r with the scale ŝ.
void estimate(const std::vector<double>& x, const std::vector<double>& r, double scale,
              Group& group) {
  const double centre[] = {median_where(r, group.inside, false),
                           median_where(r, group.inside, true)};
  std::vector<double> weights(r.size(), 1);
  std::vector<double> own(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    own[i] = r[i] - centre[group.inside[i] ? 1 : 0];
    if (scale > 0) weights[i] = bisquare_weight(own[i], scale);
  }
  const Contrast found = contrast(x, r, group.inside, weights);
  LevelEffect& level = group.named;
  level.effect = found.effect;
  level.standard_error =
      scale > 0 ? scale * std::sqrt(robust_variance(own, scale, parameters) / found.information)
                : 0;
  level.p = p_of_slower(level, r.size());
  level.share = explained_share(r, group);
}

// Whether the level was as much slower than the rest when B was accepted.
bool stood_before(const std::vector<const CorrelationCase*>& cases, const Group& group) {
  std::vector<double> inside;
  std::vector<double> outside;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!cases[i]->known_log_time_b) continue;
    (group.inside[i] ? inside : outside)
        .push_back(cases[i]->log_time_b - *cases[i]->known_log_time_b);
  }
  if (inside.empty() || outside.empty()) return false;
  return median(inside) - median(outside) < group.named.effect / 2;
}

// The slope is known less beside an offset that has to do with x: by 1/(1 − r²), r being Pearson's
// of x and the indicator.
void widen_slope(const std::vector<double>& x, const std::vector<bool>& inside, RobustLine& fit) {
  const std::vector<double> indicator(inside.begin(), inside.end());
  const double r = pearson_r(x, indicator);
  const double variance = fit.slope_error * fit.slope_error;
  const double more = variance * (1 / (1 - r * r) - 1);
  const double centre = variance > 0 ? -fit.slope_intercept_covariance / variance : 0;
  fit.slope_error = std::sqrt(variance + more);
  fit.intercept_error = std::hypot(fit.intercept_error, centre * std::sqrt(more));
  fit.slope_intercept_covariance -= centre * more;
}

// A line and an offset of the group's own, by turns until the offset stays.
struct OffsetLine {
  double offset = 0;
  RobustLine fit;  // of those outside, and of those inside without the offset
};

OffsetLine line_with_offset(const std::vector<double>& x, const std::vector<double>& y,
                            const RobustLine& plain, Group group) {
  constexpr int most_turns = 20;
  constexpr double settled = 1e-4;  // of ln t
  OffsetLine result{0, plain};
  for (int turn = 0; turn < most_turns; ++turn) {
    std::vector<double> r = result.fit.residuals;
    for (std::size_t i = 0; i < r.size(); ++i) r[i] += group.inside[i] ? result.offset : 0;
    estimate(x, r, result.fit.scale, group);
    const double moved = std::abs(group.named.effect - result.offset);
    result.offset = group.named.effect;
    std::vector<double> level(y);
    for (std::size_t i = 0; i < y.size(); ++i) level[i] -= group.inside[i] ? result.offset : 0;
    result.fit = robust_line(x, level);
    if (moved <= settled) break;
  }
  widen_slope(x, group.inside, result.fit);
  return result;
}

// Whether they are the same, or one is all that the other is not.
bool split_alike(const std::vector<bool>& a, std::vector<bool> b) {
  if (a == b) return true;
  b.flip();
  return a == b;
}

// Whether these offsets are the group's, or those of all others.
bool are_offsets_of(const Group& group, std::span<const double> offsets) {
  std::vector<bool> moved;
  for (const double offset : offsets) moved.push_back(offset != 0);
  return split_alike(group.inside, std::move(moved));
}

// From a line; of the group that it is beside with the offset.
void estimate_beside(const std::vector<const CorrelationCase*>& cases, const RobustLine& fit,
                     std::span<const double> offsets, std::vector<Group>& groups) {
  const std::vector<double> x = values_of(cases, &CorrelationCase::log_time_a);
  std::vector<double> apart = fit.residuals;
  for (std::size_t i = 0; i < offsets.size(); ++i) apart[i] += offsets[i];
  for (Group& group : groups) {
    estimate(x, are_offsets_of(group, offsets) ? apart : fit.residuals, fit.scale, group);
  }
}

double errors_of(const Group& group) {
  return std::abs(group.named.effect) / group.named.standard_error;
}

// The one whose effect is the most standard errors. The two levels of a factor that has no more are
// as far apart but for rounding: the slower one.
const Group& most_apart(const std::vector<Group>& groups) {
  constexpr double rounding = 1e-9;
  const double most = std::ranges::max(std::views::transform(groups, errors_of));
  const Group* apart = nullptr;
  for (const Group& group : groups) {
    if (errors_of(group) < (1 - rounding) * most) continue;
    if (apart == nullptr || group.named.effect > apart->named.effect) apart = &group;
  }
  return *apart;
}

// Of an effect as large by chance in any of so many levels.
double p_of_any(double errors, std::size_t levels, std::size_t configurations) {
  const auto degrees = static_cast<double>(configurations - parameters);
  return std::min(2 * student_t_upper_tail(errors, degrees) * static_cast<double>(levels), 1.0);
}

// From what a device's own times changed by: its slope is 1, and what another would explain is a
// level of long or short times. Beside the level that is apart, if one is: on either side of any
// other it would be half of the values, and which of them count as wild a matter of chance. But an
// offset is not one number for all of its level, and what makes one level apart, a slow minute say,
// may reach into others: their errors are no less than with it.
void estimate_changes(const std::vector<const CorrelationCase*>& cases, double scale,
                      std::vector<Group>& groups) {
  std::vector<double> changes;
  for (const CorrelationCase* each : cases) changes.push_back(each->log_time_b - each->log_time_a);
  const std::vector<double> nothing(cases.size(), 0);
  for (Group& group : groups) estimate(nothing, changes, scale, group);
  if (groups.empty() || !(scale > 0)) return;
  const Group& apart = most_apart(groups);
  const double p = p_of_any(errors_of(apart), groups.size(), cases.size());
  if (!is_level_told(apart.named.effect, p)) return;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i] -= apart.inside[i] ? apart.named.effect : 0;
  }
  for (Group& group : groups) {
    if (split_alike(group.inside, apart.inside)) continue;
    LevelEffect& level = group.named;
    const double with_it = level.standard_error;
    estimate(nothing, changes, scale, group);
    level.standard_error = std::max(level.standard_error, with_it);
    level.p = p_of_slower(level, cases.size());
  }
}

}  // namespace

bool is_level_told(double effect, double p) {
  return p <= Model::share_of_false_alarms &&
         std::abs(effect) >= std::log(Model::least_level_effect);
}

std::optional<LineBesideLevel> line_beside_a_level(std::span<const CorrelationCase> all,
                                                   const RobustLine& fit) {
  const auto cases = configurations_of(all);
  const std::vector<double> x = values_of(cases, &CorrelationCase::log_time_a);
  const std::vector<double> y = values_of(cases, &CorrelationCase::log_time_b);
  std::vector<Group> groups = groups_of(cases);
  if (groups.empty() || !(fit.scale > 0)) return std::nullopt;
  for (Group& group : groups) estimate(x, fit.residuals, fit.scale, group);
  const Group& apart = most_apart(groups);
  OffsetLine found = line_with_offset(x, y, fit, apart);
  const std::size_t outside = cases.size() - apart.named.size;
  const bool of_inside =
      apart.named.size > outside || (apart.named.size == outside && found.offset < 0);
  if (of_inside) found.fit.line.intercept += found.offset;
  std::vector<double> offsets;
  for (const bool inside : apart.inside) {
    const double own = inside ? found.offset : 0;
    offsets.push_back(of_inside ? own - found.offset : own);
  }
  const double p = p_of_any(errors_of(apart), groups.size(), cases.size());
  return LineBesideLevel{apart.named.factor + "=" + apart.named.level, found.offset, p,
                         std::move(found.fit), std::move(offsets)};
}

double detectable_in_errors(std::size_t tests, double degrees) {
  const double first_step = Model::share_of_false_alarms / static_cast<double>(tests);
  return student_t_upper_quantile(first_step, degrees) +
         student_t_upper_quantile(1 - Model::power, degrees);
}

std::vector<LevelEffect> level_effects(std::span<const CorrelationCase> all, const RobustLine& fit,
                                       std::span<const double> offsets, bool of_itself) {
  const auto cases = configurations_of(all);
  std::vector<Group> groups = groups_of(cases);
  if (of_itself) {
    estimate_changes(cases, fit.scale, groups);
  } else {
    estimate_beside(cases, fit, offsets, groups);
  }
  std::vector<double> p;
  for (const Group& group : groups) p.push_back(group.named.p);
  const auto q = benjamini_hochberg_adjusted(p);
  std::vector<LevelEffect> result;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    LevelEffect& level = groups[i].named;
    level.q = q[i];
    const bool worth_telling = level.effect >= std::log(Model::least_level_effect);
    level.slower = worth_telling && q[i] <= Model::share_of_false_alarms;
    level.suspected = worth_telling && q[i] <= Model::share_of_false_suspects;
    level.standing = level.suspected && stood_before(cases, groups[i]);
    level.smallest_effect =
        level.standard_error *
        detectable_in_errors(groups.size(), static_cast<double>(cases.size() - parameters));
    result.push_back(std::move(level));
  }
  // The two levels of a factor that has no more explain the same share: the slower one is named.
  std::ranges::stable_sort(result, std::greater{}, [](const LevelEffect& level) {
    return std::pair(level.effect > 0, level.share);
  });
  return result;
}

}  // namespace triptych::judge
