#include "judge/correlation/residuals.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "estimation/statistics.hpp"
#include "judge/baselines/cost_tolerance.hpp"

namespace triptych::judge {
namespace {

// A level is named only if the costs of at least this share of its configurations changed in the
// same direction.
constexpr double least_share_moved = 0.75;
constexpr std::size_t least_level = 2;

using Indices = std::vector<std::size_t>;

double mean_of(std::span<const double> values, const Indices& indices) {
  double sum = 0;
  for (const std::size_t i : indices) sum += values[i];
  return sum / static_cast<double>(indices.size());
}

bool same_direction(double a, double b) {
  return a != 0 && std::signbit(a) == std::signbit(b);
}

Movement movement(Movement::Scope scope, std::span<const double> moved, Indices members) {
  Movement result{scope, {}, std::move(members), 0, 0, 0};
  std::vector<double> values;
  for (const std::size_t i : result.members) values.push_back(moved[i]);
  std::ranges::sort(values, {}, [](double value) { return std::abs(value); });
  result.log_ratio = estimation::median(values);
  result.least = values.front();
  result.most = values.back();
  return result;
}

class Explanation {
 public:
  Explanation(std::span<const double> moved, std::span<const Factors> factors)
      : moved_(moved),
        unexplained_(moved.begin(), moved.end()),
        levels_(factor_levels(factors, least_level)) {}

  [[nodiscard]] std::vector<Movement> run() && {
    find_common_change();
    while (find_level_change()) {
    }
    find_configuration_changes();
    return std::move(result_);
  }

 private:
  void mark_explained(const Indices& members, double effect) {
    for (const std::size_t i : members) {
      const bool beyond = std::abs(unexplained_[i] - effect) > std::abs(effect);
      if (same_direction(unexplained_[i], effect) && !beyond) unexplained_[i] = 0;
    }
  }

  void find_common_change() {
    if (moved_.size() < 2) return;
    if (!std::ranges::all_of(moved_, [&](double m) { return same_direction(m, moved_[0]); })) {
      return;
    }
    Indices all(moved_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    result_.push_back(movement(Movement::Scope::everything, moved_, all));
    mark_explained(all, result_.back().log_ratio);
  }

  // Returns the mean change of the level minus the mean change of all other configurations. Returns
  // nullopt if too few configurations of the level changed in the direction of this difference.
  [[nodiscard]] std::optional<double> effect_of(const FactorLevel& level) const {
    const double effect =
        mean_of(unexplained_, level.inside) - mean_of(unexplained_, level.outside);
    const auto agreeing = std::ranges::count_if(
        level.inside, [&](std::size_t i) { return same_direction(unexplained_[i], effect); });
    const double least = least_share_moved * static_cast<double>(level.inside.size());
    if (static_cast<double>(agreeing) < least) return std::nullopt;
    return effect;
  }

  // Adds the level that explains most of the sum of squares of the remaining changes. Returns
  // false, which ends the search, if there is no such level, or if the level leaves as many changes
  // unexplained as before.
  bool find_level_change() {
    const FactorLevel* best = nullptr;
    double most = 0;
    double best_effect = 0;
    for (const FactorLevel& level : levels_) {
      const auto effect = effect_of(level);
      if (!effect) continue;
      const auto inside = static_cast<double>(level.inside.size());
      const auto outside = static_cast<double>(level.outside.size());
      const double explained = *effect * *effect * inside * outside / (inside + outside);
      if (explained <= most) continue;
      best = &level;
      most = explained;
      best_effect = *effect;
    }
    if (best == nullptr) return false;
    result_.push_back(movement(Movement::Scope::level, moved_, best->inside));
    result_.back().level = best->name;
    result_.back().log_ratio = best_effect;
    const auto before = std::ranges::count(unexplained_, 0.0);
    mark_explained(best->inside, best_effect);
    return std::ranges::count(unexplained_, 0.0) > before;
  }

  void find_configuration_changes() {
    Indices order;
    for (std::size_t i = 0; i < unexplained_.size(); ++i) {
      if (unexplained_[i] != 0) order.push_back(i);
    }
    std::ranges::stable_sort(order, std::greater{},
                             [&](std::size_t i) { return std::abs(moved_[i]); });
    for (const std::size_t i : order) {
      result_.push_back(movement(Movement::Scope::configuration, moved_, {i}));
    }
  }

  std::span<const double> moved_;
  std::vector<double> unexplained_;  // the changes that are not explained yet; all others are 0
  std::vector<FactorLevel> levels_;
  std::vector<Movement> result_;
};

}  // namespace

Repeatability repeatability(std::string_view device, std::string_view technique,
                            const FrameCost& stored) {
  const double sum = std::max(stored.sum(), 1.0);
  const auto share = [&](std::string_view part, double count) {
    return cost_tolerance(part, device, technique, count, sum) / sum;
  };
  return {.device_code = share("device_code", stored.device_code),
          .driver = share("driver", stored.driver)};
}

Repeatability operator+(const Repeatability& a, const Repeatability& b) {
  return {a.device_code + b.device_code, a.driver + b.driver};
}

CostChange change_of(const FrameCost& stored, const FrameCost& now) {
  return {(now.device_code - stored.device_code) / stored.sum(),
          (now.driver - stored.driver) / stored.sum()};
}

double significant_change(const CostChange& change, const Repeatability& bound) {
  double beyond = 0;
  if (std::abs(change.device_code) > bound.device_code) beyond += change.device_code;
  if (std::abs(change.driver) > bound.driver) beyond += change.driver;
  return std::log1p(beyond);
}

bool residual_moved(const CostChange& a, const Repeatability& bound_a, const CostChange& b,
                    const Repeatability& bound_b) {
  const CostChange difference{b.device_code - a.device_code, b.driver - a.driver};
  return significant_change(difference, bound_a + bound_b) != 0;
}

std::vector<Movement> explain(std::span<const double> moved, std::span<const Factors> factors) {
  return Explanation(moved, factors).run();
}

}  // namespace triptych::judge
