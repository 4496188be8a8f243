#pragma once
// How a factor divides observations into levels, and what pairs them across levels.

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/observations.hpp"

namespace triptych::analysis {

using Chosen = std::vector<const Observation*>;

// What a number was computed from.
struct Scope {
  std::map<std::string, std::string> held;  // factors with one value throughout, and that value
  std::vector<std::string> varied;          // the others
  std::size_t samples = 0;                  // observations
};
[[nodiscard]] Scope scope_of(const Chosen& chosen);
[[nodiscard]] std::string text_of(const std::map<std::string, std::string>& held);  // "a=1, b=2"

// Besides the records' own factors, the camera's parts as the paper has them:
//   camera_path      the path, its position among the other factors; random views have none
//   camera_rotation  the position on an orbit, the axis among the other factors
//   camera_distance  the position on the straight paths x, y, z, the axis among the others
inline constexpr std::string_view camera_path = "camera_path";
inline constexpr std::string_view camera_rotation = "camera_rotation";
inline constexpr std::string_view camera_distance = "camera_distance";

struct Level {
  std::string name;
  std::map<std::string, const Observation*> by_key;  // by all other factors, as text
};
struct Split {
  std::string factor;
  std::vector<Level> levels;  // in natural order
};

// The factors with at least two levels, "camera" replaced by its parts; by name.
[[nodiscard]] std::vector<std::string> factors_of(const Dataset& dataset);
[[nodiscard]] Split split(const Dataset& dataset, std::string_view factor);

// Level of a factor; for camera_path also "random", which pairs with nothing but can be averaged.
[[nodiscard]] std::optional<std::string> level_of(const Observation& observation,
                                                  std::string_view factor);
// All factors but those left out, as text. Leaving out a part of the camera leaves out all of it.
[[nodiscard]] std::string key_without(const Observation& observation,
                                      std::span<const std::string_view> left_out);

// The observations whose key (all factors but these) occurs with the largest number of
// combinations of the factors' levels, the same of each; of several such sets the one with the most
// observations: what is compared then differs in these factors alone.
[[nodiscard]] Chosen fullest_block(const Chosen& from, std::span<const std::string_view> factors);
[[nodiscard]] Chosen all_of(const Dataset& dataset);

}  // namespace triptych::analysis
