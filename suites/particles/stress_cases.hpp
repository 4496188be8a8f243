#pragma once
// Scenes that break renderers of spheres, each with what has to come out of it: data "stress:CASE"
// or "stress:CASE:VARIANT". They bring a camera and a viewport of their own, which the factors
// `camera`, `fov` and `viewport` take by the level `own`.
//
// What is asked of every picture: in each certain pixel (reference/spheres.hpp) the truth's id, its
// depth and its colour within the bounds of tolerance.hpp, in the others a colour that is possible
// there. A case says why single precision can do that, and what is asked beyond it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/stress_name.hpp"
#include "record/expectation.hpp"
#include "scene/particles.hpp"

namespace triptych::particles_suite {

// The level of `camera`, `fov` and `viewport` that means what belongs to the data.
using measure::own_level;

struct StressCase {
  int number = 0;  // in the catalogue of docs/accuracy.md
  std::string_view name;
  std::string_view summary;                // what is hostile
  std::string_view expected;               // what has to come out, and why it can
  std::vector<std::string_view> variants;  // none: the case has one scene
};
// By number.
[[nodiscard]] const std::vector<StressCase>& stress_cases();

using StressData = measure::StressChoice<StressCase>;
// As a plan spells it.
[[nodiscard]] std::string name_of(const StressData& data);

// nullopt for other data. Throws InputError for an unknown case or variant.
[[nodiscard]] std::optional<StressData> stress_data(std::string_view data);

struct StressScene {
  scene::ParticleSet particles;
  scene::Camera camera;
  int width = 0;
  int height = 0;
  // The eye of the frame before the first, where a case is about what is left of it.
  std::optional<scene::Camera> camera_before = {};
};
[[nodiscard]] StressScene stress_scene(const StressData& data, scene::ColourKind colour);

// What has to hold beside the truth.
[[nodiscard]] std::vector<record::Expectation> stress_expectations(const StressData& data);

}  // namespace triptych::particles_suite
