#pragma once
// Scenes on which sphere renderers often fail, each with the expected result. A plan selects a
// scene with the level `stress:CASE` or `stress:CASE:VARIANT` of the factor `data`. Each scene has
// its own camera and viewport, which are used if the factors `camera`, `fov` and `viewport` have
// the level `own`.
//
// A pixel is certain if every device must show the same particle there, whatever its rounding
// errors are (reference/spheres.hpp). In every image, each certain pixel must show the same
// particle as the reference image, with depth and colour within the bounds of tolerance.hpp. Any
// other pixel must show one of the colours that rounding errors make possible there. Each case
// states why single precision is sufficient for this, and what else is expected.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/stress_name.hpp"
#include "record/expectation.hpp"
#include "scene/particles.hpp"

namespace triptych::particles_suite {

// With this level, `camera`, `fov` and `viewport` use the values that the stress case defines.
using measure::own_level;

struct StressCase {
  int number = 0;  // number in the catalogue of docs/accuracy.md
  std::string_view name;
  std::string_view summary;                // what makes the case difficult
  std::string_view expected;               // the expected result, and why it is achievable
  std::vector<std::string_view> variants;  // empty if the case has only one scene
};
// Returns all cases, sorted by number.
[[nodiscard]] const std::vector<StressCase>& stress_cases();

using StressData = measure::StressChoice<StressCase>;
// Returns the level of the factor `data` that selects this stress scene in a plan.
[[nodiscard]] std::string name_of(const StressData& data);

// Returns nullopt if `data` does not name a stress case. Throws InputError if the case or variant
// is unknown.
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

// Returns the expectations of the case, in addition to its error bound.
[[nodiscard]] std::vector<record::Expectation> stress_expectations(const StressData& data);

}  // namespace triptych::particles_suite
