#pragma once
// Groups configurations by the factor levels that they share.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace triptych::judge {

using Factors = std::map<std::string, std::string>;

struct FactorLevel {
  std::string name;  // "factor=level", and the levels that occur in exactly the same configurations
  std::vector<std::size_t> inside;   // indices of the configurations with this level, ascending
  std::vector<std::size_t> outside;  // indices of all other configurations, ascending
};

// Returns the levels that are set in at least `least_members` configurations and not set in at
// least `least_members` others, sorted by name. Levels that occur in exactly the same
// configurations cannot be distinguished, so they are combined: "ray=vertex (= corners=4)".
[[nodiscard]] std::vector<FactorLevel> factor_levels(std::span<const Factors> configurations,
                                                     std::size_t least_members);

}  // namespace triptych::judge
