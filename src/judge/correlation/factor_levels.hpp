#pragma once
// Which configurations share a level of a factor.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace triptych::judge {

using Factors = std::map<std::string, std::string>;

struct FactorLevel {
  std::string name;  // "factor=level", and the other levels that hold the same configurations
  std::vector<std::size_t> inside;  // indices, ascending
  std::vector<std::size_t> outside;
};

// The levels with at least `least` configurations inside and outside, sorted by name. Levels that
// hold the same configurations cannot be told apart and become one: "ray=vertex (= corners=4)".
[[nodiscard]] std::vector<FactorLevel> factor_levels(std::span<const Factors> configurations,
                                                     std::size_t least);

}  // namespace triptych::judge
