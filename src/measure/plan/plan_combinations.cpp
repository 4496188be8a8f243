#include "measure/plan/plan_combinations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "measure/plan/plan_values.hpp"

namespace triptych::measure {
namespace {

// More is a slip of the pen: at a tenth of a second each these would take a day.
constexpr std::size_t most_configurations = 1'000'000;

// A factor and its values; those before it vary more slowly.
struct Axis {
  const Factor* factor;
  std::vector<std::string> values;
};

// Loading data costs most, then building a pipeline, then moving the camera.
int speed_of(const Factor& factor) {
  if (factor.name == "data") return 0;
  if (factor.name == "viewport") return 2;
  if (factor.name == "camera") return 3;
  return 1;
}

std::vector<Axis> axes_of(const Suite& suite, const ValuesByFactor& values) {
  std::vector<Axis> axes;
  for (const Factor* factor : slowest_first(suite)) {
    const auto given = values.find(factor->name);
    axes.push_back(
        {factor, given == values.end() ? std::vector{standard_of(*factor)} : given->second});
  }
  return axes;
}

void require_few(const std::vector<Axis>& axes, const core::FilePlace& place) {
  std::size_t count = 1;
  for (const Axis& axis : axes) {
    count *= axis.values.size();
    if (count > most_configurations) {
      throw core::InputError(
          place, fmt::format("more than {} combinations, most of this factor; split the plan",
                             most_configurations));
    }
  }
}

// As an odometer: the last axis turns at every step.
std::vector<Configuration> combine(const std::vector<Axis>& axes) {
  std::vector<Configuration> configurations;
  std::vector<std::size_t> place(axes.size(), 0);
  for (;;) {
    Configuration& configuration = configurations.emplace_back();
    for (std::size_t i = 0; i < axes.size(); ++i) {
      configuration[axes[i].factor->name] = axes[i].values[place[i]];
    }
    std::size_t turning = axes.size();
    while (turning > 0 && ++place[turning - 1] == axes[turning - 1].values.size()) {
      place[--turning] = 0;
    }
    if (turning == 0) return configurations;
  }
}

}  // namespace

std::vector<const Factor*> slowest_first(const Suite& suite) {
  std::vector<const Factor*> factors;
  for (const Factor& each : suite.factors()) factors.push_back(&each);
  std::ranges::stable_sort(factors, {}, [](const Factor* factor) { return speed_of(*factor); });
  return factors;
}

std::vector<Configuration> all_combinations(const Suite& suite, const ValuesByFactor& values,
                                            const core::FilePlace& place) {
  const std::vector<Axis> axes = axes_of(suite, values);
  require_few(axes, place);
  return combine(axes);
}

void add_combinations(const std::vector<Configuration>& more,
                      std::vector<Configuration>& configurations) {
  const std::set<Configuration> known(configurations.begin(), configurations.end());
  for (const Configuration& each : more) {
    if (!known.contains(each)) configurations.push_back(each);
  }
  std::map<std::string, std::size_t> rank;
  for (const Configuration& each : configurations) rank.emplace(each.at("data"), rank.size());
  std::ranges::stable_sort(configurations, {},
                           [&](const Configuration& each) { return rank.at(each.at("data")); });
}

}  // namespace triptych::measure
