#pragma once
// Scenes that break renderers of spheres, each with the expected result: data "stress:CASE" or
// "stress:CASE:VARIANT". They bring their own camera and viewport, which the factors `camera`,
// `fov` and `viewport` use with the level `own`.
//
// In every image a certain pixel (reference/spheres.hpp) must show the reference's id, with depth
// and colour within the bounds of tolerance.hpp; any other pixel must show a colour that is
// possible there. Each case states why single precision can achieve that, and what else is
// expected.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/stress_name.hpp"
#include "record/expectation.hpp"
#include "scene/particles.hpp"

namespace triptych::particles_suite {

// The level of `camera`, `fov` and `viewport` that selects the value that belongs to the data.
using measure::own_level;

struct StressCase {
  int number = 0;  // number in the catalogue of docs/accuracy.md
  std::string_view name;
  std::string_view summary;                // why renderers fail on it
  std::string_view expected;               // the expected result, and why it is achievable
  std::vector<std::string_view> variants;  // empty if the case has only one scene
};
// All cases, sorted by number.
[[nodiscard]] const std::vector<StressCase>& stress_cases();

using StressData = measure::StressChoice<StressCase>;
// The name of the data in a plan.
[[nodiscard]] std::string name_of(const StressData& data);

// nullopt for other data. Throws InputError for an unknown case or variant.
[[nodiscard]] std::optional<StressData> stress_data(std::string_view data);

struct StressScene {
  scene::ParticleSet particles;
  scene::Camera camera;
  int width = 0;
  int height = 0;
  // The camera of the previous frame, for a case that tests the effect of one frame on the next.
  std::optional<scene::Camera> camera_before = {};
};
[[nodiscard]] StressScene stress_scene(const StressData& data, scene::ColourKind colour);

// Expectations in addition to the bound.
[[nodiscard]] std::vector<record::Expectation> stress_expectations(const StressData& data);

}  // namespace triptych::particles_suite
