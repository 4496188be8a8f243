#include "analysis/splits.hpp"

#include <algorithm>
#include <set>

namespace triptych::analysis {
namespace {

bool is_part_of_camera(std::string_view factor) {
  return factor == camera_path || factor == camera_rotation || factor == camera_distance;
}

bool is_orbit(std::string_view path) {
  return path.starts_with("orbit_");
}

bool is_straight(std::string_view path) {
  return path == "path_x" || path == "path_y" || path == "path_z";
}

std::string camera_of(const Observation& observation) {
  const auto camera = observation.factors.find("camera");
  return camera == observation.factors.end() ? std::string() : camera->second;
}

struct Place {
  std::string level;
  std::string of_camera;  // what of the camera stays among the other factors
};

// Where an observation stands in a split by a part of the camera.
std::optional<Place> place_of(const Observation& observation, std::string_view part) {
  const View view = view_of(camera_of(observation));
  if (view.path.empty()) return std::nullopt;
  if (part == camera_path) {
    if (view.path == "random") return std::nullopt;
    return Place{view.path, view.position};
  }
  const bool mine = part == camera_rotation ? is_orbit(view.path) : is_straight(view.path);
  if (!mine) return std::nullopt;
  return Place{view.position, view.path};
}

}  // namespace

Scope scope_of(const Chosen& chosen) {
  Scope scope{.samples = chosen.size()};
  std::map<std::string, std::set<std::string>> values;
  for (const Observation* each : chosen) {
    for (const auto& [factor, value] : each->factors) values[factor].insert(value);
  }
  for (const auto& [factor, of_factor] : values) {
    if (of_factor.size() == 1) {
      scope.held[factor] = *of_factor.begin();
    } else {
      scope.varied.push_back(factor);
    }
  }
  return scope;
}

std::string text_of(const std::map<std::string, std::string>& held) {
  std::string text;
  for (const auto& [factor, value] : held) {
    if (!text.empty()) text += ", ";
    text += factor + '=' + value;
  }
  return text;
}

std::vector<std::string> factors_of(const Dataset& dataset) {
  std::vector<std::string> factors;
  std::vector<std::string> candidates = scope_of(all_of(dataset)).varied;
  for (const std::string& factor : candidates) {
    if (factor == "camera") {
      for (const std::string_view part : {camera_path, camera_rotation, camera_distance}) {
        if (split(dataset, part).levels.size() > 1) factors.emplace_back(part);
      }
    } else {
      factors.push_back(factor);
    }
  }
  std::ranges::sort(factors);
  return factors;
}

Split split(const Dataset& dataset, std::string_view factor) {
  const bool part = is_part_of_camera(factor);
  std::map<std::string, Level> levels;
  for (const Observation& observation : dataset.observations) {
    std::string key = key_without(observation, std::span(&factor, 1));
    std::optional<std::string> name;
    if (part) {
      const std::optional<Place> place = place_of(observation, factor);
      if (!place) continue;
      name = place->level;
      key += "camera=" + place->of_camera;
    } else {
      name = level_of(observation, factor);
    }
    if (name) levels[*name].by_key.emplace(std::move(key), &observation);
  }
  Split result{.factor = std::string(factor), .levels = {}};
  for (auto& [name, level] : levels) {
    level.name = name;
    result.levels.push_back(std::move(level));
  }
  std::ranges::sort(result.levels, natural_less, &Level::name);
  return result;
}

std::optional<std::string> level_of(const Observation& observation, std::string_view factor) {
  if (is_part_of_camera(factor)) {
    const View view = view_of(camera_of(observation));
    if (factor == camera_path && !view.path.empty()) return view.path;
    const std::optional<Place> place = place_of(observation, factor);
    return place ? std::optional(place->level) : std::nullopt;
  }
  const auto found = observation.factors.find(std::string(factor));
  if (found == observation.factors.end()) return std::nullopt;
  return found->second;
}

std::string key_without(const Observation& observation,
                        std::span<const std::string_view> left_out) {
  std::string key;
  for (const auto& [factor, value] : observation.factors) {
    const bool out = std::ranges::any_of(left_out, [&](std::string_view each) {
      return factor == (is_part_of_camera(each) ? std::string_view("camera") : each);
    });
    if (!out) key += factor + '=' + value + ',';
  }
  return key;
}

Chosen fullest_block(const Chosen& from, std::span<const std::string_view> factors) {
  using Combinations = std::set<std::vector<std::string>>;
  struct Block {
    Combinations combinations;
    Chosen members;
  };
  std::map<std::string, Block> blocks;
  for (const Observation* each : from) {
    std::vector<std::string> combination;
    for (const std::string_view factor : factors) {
      if (const auto level = level_of(*each, factor)) combination.push_back(*level);
    }
    if (combination.size() < factors.size()) continue;
    Block& block = blocks[key_without(*each, factors)];
    block.combinations.insert(std::move(combination));
    block.members.push_back(each);
  }
  // Blocks of other combinations would differ in what is left out of the comparison.
  std::map<Combinations, Chosen> by_combinations;
  for (const auto& [key, block] : blocks) {
    Chosen& members = by_combinations[block.combinations];
    members.insert(members.end(), block.members.begin(), block.members.end());
  }
  const auto fullness = [](const auto& each) {
    return std::pair(each.first.size(), each.second.size());
  };
  const auto fullest = std::ranges::max_element(by_combinations, {}, fullness);
  return fullest == by_combinations.end() ? Chosen{} : fullest->second;
}

Chosen all_of(const Dataset& dataset) {
  Chosen chosen;
  for (const Observation& each : dataset.observations) chosen.push_back(&each);
  return chosen;
}

}  // namespace triptych::analysis
