#pragma once
// Volumes that break renderers, each with what has to come out of it: data "stress:CASE" or
// "stress:CASE:VARIANT". They bring a transfer function, camera, viewport, step, quadrature,
// shading and early termination of their own, which the factors take by the level `own`.
//
// What is asked of every picture: that it lies within its bound of the truth (tolerance.hpp), and
// that skipping empty space changes no bit of it. A case says why single precision can do that, and
// what is asked beyond it.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/stress_name.hpp"
#include "record/expectation.hpp"
#include "scene/camera.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::volume_suite {

// The level that means what belongs to the data.
using measure::own_level;

// All but its volume is what the levels `own` stand for.
struct StressScene {
  scene::Volume volume;
  scene::TransferFunction function;
  scene::Camera camera;
  int width = 24;
  int height = 24;
  double step_voxels = 0.5;
  double ert = 0;
  bool shaded = false;
  scene::Quadrature quadrature = scene::Quadrature::midpoint;
  std::array<float, 4> background{0.25F, 0.125F, 0.0625F, 1};
  std::vector<record::Expectation> expectations = {};
  std::vector<record::Expectation> when_skipping = {};  // only where empty space is skipped …
  std::vector<record::Expectation> when_leaping = {};   // … and by leaps (skip: distance)
};

struct StressCase {
  int number = 0;  // in the catalogue of docs/accuracy.md
  std::string_view name;
  std::string_view summary;                // what is hostile
  std::string_view expected;               // what has to come out, and why it can
  std::vector<std::string_view> variants;  // none: the case has one scene
  StressScene (*scene)(std::string_view variant) = nullptr;
};
// By number.
[[nodiscard]] const std::vector<StressCase>& stress_cases();

using StressData = measure::StressChoice<StressCase>;
// As a plan spells it.
[[nodiscard]] std::string name_of(const StressData& data);

// nullopt for other data. Throws InputError for an unknown case or variant.
[[nodiscard]] std::optional<StressData> stress_data(std::string_view data);

// The volume's name is that of the data.
[[nodiscard]] StressScene stress_scene(const StressData& data);

}  // namespace triptych::volume_suite
