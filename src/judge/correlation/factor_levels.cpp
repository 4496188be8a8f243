#include "judge/correlation/factor_levels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace triptych::judge {

std::vector<FactorLevel> factor_levels(std::span<const Factors> configurations,
                                       std::size_t least_members) {
  std::map<std::string, std::vector<std::size_t>> inside;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    for (const auto& [factor, level] : configurations[i]) {
      inside[fmt::format("{}={}", factor, level)].push_back(i);
    }
  }
  std::map<std::vector<std::size_t>, std::vector<std::string>> names;
  for (const auto& [name, members] : inside) {
    if (members.size() >= least_members &&
        configurations.size() - members.size() >= least_members) {
      names[members].push_back(name);
    }
  }
  std::vector<FactorLevel> levels;
  for (const auto& [members, equal_levels] : names) {
    FactorLevel level{equal_levels.front(), members, {}};
    if (equal_levels.size() > 1) {
      level.name +=
          fmt::format(" (= {})", fmt::join(equal_levels.begin() + 1, equal_levels.end(), ", "));
    }
    for (std::size_t i = 0; i < configurations.size(); ++i) {
      if (!std::ranges::binary_search(members, i)) level.outside.push_back(i);
    }
    levels.push_back(std::move(level));
  }
  std::ranges::sort(levels, {}, &FactorLevel::name);
  return levels;
}

}  // namespace triptych::judge
