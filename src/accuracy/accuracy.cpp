#include "accuracy/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <set>

#include "estimation/regression.hpp"
#include "estimation/statistics.hpp"

namespace triptych::accuracy {
namespace {

using Factors = std::map<std::string, std::string>;

constexpr double coarsest_step = 1;
constexpr double largest_arithmetic_share = 0.1;
constexpr std::size_t least_points = 3;
constexpr double tail = 0.025;  // probability of each tail outside a 95 % confidence interval

// Returns the factors (settings of a configuration) whose values differ among the cases, except for
// the factor `step`.
std::set<std::string> varying_factors(std::span<const AccuracyCase> cases) {
  std::set<std::string> names;
  for (const AccuracyCase& each : cases) {
    for (const auto& [name, value] : each.factors) {
      const auto first = cases.front().factors.find(name);
      if (first == cases.front().factors.end() || first->second != value) names.insert(name);
    }
  }
  names.erase("step");
  return names;
}

std::string family_name(const AccuracyCase& each, const std::set<std::string>& varying) {
  std::string name;
  for (const std::string& factor : varying) {
    const auto value = each.factors.find(factor);
    if (value == each.factors.end()) continue;
    name += fmt::format("{}{}={}", name.empty() ? "" : ", ", factor, value->second);
  }
  return name;
}

std::optional<Order> order_of(std::span<const AccuracyCase> cases,
                              std::span<const std::size_t> members) {
  std::vector<StepError> points;
  for (const std::size_t i : members) {
    if (const auto step = step_of(cases[i])) {
      points.push_back({*step, cases[i].rmse, cases[i].arithmetic});
    }
  }
  return fit_order(points);
}

// Returns whether `a` is at least as good as `b` in both cost and error, and better in at least one
// of them. Requires that both have a cost.
bool beats(const AccuracyCase& a, const AccuracyCase& b, const CostOf& cost_of) {
  const double cost_a = *cost_of(a);
  const double cost_b = *cost_of(b);
  return cost_a <= cost_b && a.rmse <= b.rmse && (cost_a < cost_b || a.rmse < b.rmse);
}

// Returns the only factor in which `a` and `b` differ, or nullopt if they differ in none or in
// several.
std::optional<std::string> only_difference(const Factors& a, const Factors& b) {
  if (a.size() != b.size()) return std::nullopt;
  std::optional<std::string> only;
  for (const auto& [name, value] : a) {
    const auto other = b.find(name);
    if (other == b.end()) return std::nullopt;
    if (other->second == value) continue;
    if (only) return std::nullopt;
    only = name;
  }
  return only;
}

// Returns the indices of the cases, sorted by error. If errors are equal, the fastest case comes
// first.
std::vector<std::size_t> by_accuracy(std::span<const AccuracyCase> cases) {
  std::vector<std::size_t> order(cases.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    constexpr double untimed = std::numeric_limits<double>::infinity();
    return std::pair(cases[i].rmse, cases[i].time_ns.value_or(untimed));
  });
  return order;
}

// Returns the cost at the given error, interpolated along a straight line between two points on
// logarithmic axes. Returns nullopt if the error is not between those of the two points, or if one
// of the points has no cost or an error of 0.
std::optional<double> cost_between(const AccuracyCase& a, const AccuracyCase& b,
                                   const CostOf& cost_of, double error) {
  const auto cost_a = cost_of(a);
  const auto cost_b = cost_of(b);
  if (!cost_a || !cost_b) return std::nullopt;
  const bool between = std::min(a.rmse, b.rmse) < error && error < std::max(a.rmse, b.rmse);
  if (!between || !(std::min(a.rmse, b.rmse) > 0)) return std::nullopt;
  const double share = std::log(error / a.rmse) / std::log(b.rmse / a.rmse);
  return *cost_a * std::pow(*cost_b / *cost_a, share);
}

std::optional<double> time_of(const AccuracyCase& each) {
  return each.time_ns;
}

}  // namespace

std::optional<double> step_of(const AccuracyCase& each) {
  const auto found = each.factors.find("step");
  if (found == each.factors.end()) return std::nullopt;
  return std::strtod(found->second.c_str(), nullptr);
}

std::optional<Order> fit_order(std::span<const StepError> points) {
  std::vector<double> x;
  std::vector<double> y;
  for (const StepError& point : points) {
    const bool resolved =
        point.error > 0 && point.arithmetic <= largest_arithmetic_share * point.error;
    if (!resolved || point.step > coarsest_step) continue;
    x.push_back(std::log(point.step));
    y.push_back(std::log(point.error));
  }
  if (x.size() < least_points) return std::nullopt;
  const estimation::LeastSquares fit = estimation::least_squares(x, y);
  if (!std::isfinite(fit.line.slope) || !std::isfinite(fit.slope_error)) return std::nullopt;
  const double t = estimation::student_t_upper_quantile(tail, static_cast<double>(x.size() - 2));
  return Order{fit.line.slope, t * fit.slope_error, x.size()};
}

std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases, const CostOf& cost_of) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cost_of(cases[i])) order.push_back(i);
  }
  std::ranges::stable_sort(
      order, {}, [&](std::size_t i) { return std::pair(*cost_of(cases[i]), cases[i].rmse); });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (front.empty() || cases[i].rmse < cases[front.back()].rmse) front.push_back(i);
  }
  return front;
}

std::vector<std::size_t> pareto_front(std::span<const AccuracyCase> cases) {
  return pareto_front(cases, time_of);
}

std::vector<Dominated> dominated(std::span<const AccuracyCase> cases,
                                 std::span<const std::size_t> front, const CostOf& cost_of) {
  std::vector<Dominated> result;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!cost_of(cases[i])) continue;
    const auto by = std::ranges::find_if(
        front, [&](std::size_t better) { return beats(cases[better], cases[i], cost_of); });
    if (by != front.end()) result.push_back({i, *by});
  }
  return result;
}

std::vector<Dominated> dominated(std::span<const AccuracyCase> cases,
                                 std::span<const std::size_t> front) {
  return dominated(cases, front, time_of);
}

std::vector<AccuracyFamily> accuracy_families(std::span<const AccuracyCase> cases) {
  if (cases.empty()) return {};
  const std::set<std::string> varying = varying_factors(cases);
  std::map<std::string, AccuracyFamily> families;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string name = family_name(cases[i], varying);
    families[name].name = name;
    families[name].members.push_back(i);
  }
  std::vector<AccuracyFamily> result;
  for (auto& [name, family] : families) {
    std::ranges::stable_sort(family.members, std::greater{},
                             [&](std::size_t i) { return step_of(cases[i]).value_or(0); });
    family.order = order_of(cases, family.members);
    result.push_back(std::move(family));
  }
  return result;
}

std::optional<double> cost_to_error(std::span<const AccuracyCase> cases,
                                    std::span<const AccuracyFamily> families, const CostOf& cost_of,
                                    double error) {
  std::optional<double> least;
  const auto consider = [&](const std::optional<double>& cost) {
    if (cost) least = std::min(least.value_or(*cost), *cost);
  };
  for (const AccuracyCase& each : cases) {
    if (each.rmse <= error) consider(cost_of(each));
  }
  for (const AccuracyFamily& family : families) {
    for (std::size_t i = 0; i + 1 < family.members.size(); ++i) {
      const AccuracyCase& shorter = cases[family.members[i]];
      consider(cost_between(shorter, cases[family.members[i + 1]], cost_of, error));
    }
  }
  return least;
}

std::optional<double> time_to_error(std::span<const AccuracyCase> cases,
                                    std::span<const AccuracyFamily> families, double error) {
  return cost_to_error(cases, families, time_of, error);
}

std::size_t most_accurate(std::span<const AccuracyCase> cases) {
  return by_accuracy(cases).front();
}

std::vector<FactorSwitch> single_factor_switches(std::span<const AccuracyCase> cases) {
  std::map<std::string, std::vector<FactorSwitch>> by_factor;
  for (const std::size_t from : by_accuracy(cases)) {
    for (std::size_t to = 0; to < cases.size(); ++to) {
      const auto factor = only_difference(cases[from].factors, cases[to].factors);
      if (!factor) continue;
      std::vector<FactorSwitch>& known = by_factor[*factor];
      if (known.empty() || known.front().from == from) known.push_back({*factor, from, to});
    }
  }
  std::vector<FactorSwitch> result;
  for (const auto& [factor, switched] : by_factor) {
    result.insert(result.end(), switched.begin(), switched.end());
  }
  return result;
}

std::optional<FactorSwitch> factor_switch_between(std::span<const AccuracyCase> cases,
                                                  std::span<const AccuracyCase> others,
                                                  std::string_view factor) {
  for (const std::size_t from : by_accuracy(cases)) {
    for (std::size_t to = 0; to < others.size(); ++to) {
      const auto only = only_difference(cases[from].factors, others[to].factors);
      if (only && *only == factor) return FactorSwitch{*only, from, to};
    }
  }
  return std::nullopt;
}

}  // namespace triptych::accuracy
