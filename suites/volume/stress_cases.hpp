#pragma once
// Volumes that break renderers, each with the expected result: data "stress:CASE" or
// "stress:CASE:VARIANT". They bring their own transfer function, camera, viewport, step,
// quadrature, shading and early termination, which the factors use with the level `own`.
//
// Every image must be within its bound of the reference image (tolerance.hpp), and skipping empty
// space must not change a bit of it. Each case states why single precision can achieve that, and
// what else is expected.

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

// The level that selects the value that belongs to the data.
using measure::own_level;

// A case's volume, and the values of the level `own`.
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
  std::vector<record::Expectation> when_skipping = {};  // applies only if empty space is skipped
  std::vector<record::Expectation> when_leaping =
      {};  // applies only if it is skipped by leaps (skip: distance)
};

struct StressCase {
  int number = 0;  // number in the catalogue of docs/accuracy.md
  std::string_view name;
  std::string_view summary;                // why renderers fail on it
  std::string_view expected;               // the expected result, and why it is achievable
  std::vector<std::string_view> variants;  // empty if the case has only one scene
  StressScene (*scene)(std::string_view variant) = nullptr;
};
// All cases, sorted by number.
[[nodiscard]] const std::vector<StressCase>& stress_cases();

using StressData = measure::StressChoice<StressCase>;
// The name of the data in a plan.
[[nodiscard]] std::string name_of(const StressData& data);

// nullopt for other data. Throws InputError for an unknown case or variant.
[[nodiscard]] std::optional<StressData> stress_data(std::string_view data);

// The scene of the data; its volume has the name of the data.
[[nodiscard]] StressScene stress_scene(const StressData& data);

}  // namespace triptych::volume_suite
