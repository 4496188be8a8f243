#pragma once
// Volumes on which renderers often fail, each with the expected result. A plan selects a volume
// with the level `stress:CASE` or `stress:CASE:VARIANT` of the factor `data`. Each case has its own
// transfer function, camera, viewport, step, quadrature, shading and early termination, which apply
// to the factors that have the level `own`.
//
// Every image must be within its bound of the reference image (tolerance.hpp), and must be
// bit-identical with and without skipping of empty space. Each case states why single precision is
// sufficient to meet these requirements, and what else is expected.

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

// With this level, a factor uses the value that the stress case defines.
using measure::own_level;

// The volume of a stress case, and the values that its factors have at the level `own`.
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
  std::vector<record::Expectation> when_skipping = {};  // applied only if skip is not none
  std::vector<record::Expectation> when_leaping = {};   // applied only if skip is distance
};

struct StressCase {
  int number = 0;  // number in the catalogue of docs/accuracy.md
  std::string_view name;
  std::string_view summary;                // what makes the case difficult
  std::string_view expected;               // the expected result, and why it is achievable
  std::vector<std::string_view> variants;  // empty if the case has only one scene
  StressScene (*scene)(std::string_view variant) = nullptr;
};
// Returns all cases, sorted by number.
[[nodiscard]] const std::vector<StressCase>& stress_cases();

using StressData = measure::StressChoice<StressCase>;
// Returns the level of the factor `data` that selects this stress case in a plan.
[[nodiscard]] std::string name_of(const StressData& data);

// Returns nullopt if `data` does not name a stress case. Throws InputError if the case or variant
// is unknown.
[[nodiscard]] std::optional<StressData> stress_data(std::string_view data);

// Returns the scene of the stress case. Its volume has the same name as the data.
[[nodiscard]] StressScene stress_scene(const StressData& data);

}  // namespace triptych::volume_suite
