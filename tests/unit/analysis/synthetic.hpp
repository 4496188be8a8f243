#pragma once
// Data sets of known structure.

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/observations.hpp"

namespace triptych::analysis {

using Factors = std::map<std::string, std::string>;

// Every combination of the levels, with the time that `ms` gives it.
inline Dataset factorial(const std::vector<std::pair<std::string, std::vector<std::string>>>& plan,
                         const std::function<double(const Factors&)>& ms) {
  std::vector<Factors> combinations{{}};
  for (const auto& [factor, levels] : plan) {
    std::vector<Factors> longer;
    for (const Factors& each : combinations) {
      for (const std::string& level : levels) {
        longer.push_back(each);
        longer.back()[factor] = level;
      }
    }
    combinations = std::move(longer);
  }
  Dataset dataset{.suite = "volume", .clock = "wall"};
  for (Factors& each : combinations) {
    const double time = ms(each);
    dataset.observations.push_back({.factors = std::move(each), .ms = time, .wall_ms = time});
  }
  return dataset;
}

}  // namespace triptych::analysis
