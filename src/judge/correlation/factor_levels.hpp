#pragma once
// The configurations that share a level of a factor.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace triptych::judge {

using Factors = std::map<std::string, std::string>;

struct FactorLevel {
  std::string name;  // "factor=level", and other levels that the same configurations have
  std::vector<std::size_t> inside;  // indices, ascending
  std::vector<std::size_t> outside;
};

// The levels with at least `least` configurations inside and outside, sorted by name. Levels with
// the same configurations cannot be distinguished and are combined: "ray=vertex (= corners=4)".
[[nodiscard]] std::vector<FactorLevel> factor_levels(std::span<const Factors> configurations,
                                                     std::size_t least);

}  // namespace triptych::judge
