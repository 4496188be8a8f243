#pragma once
#include <glm/vec3.hpp>

namespace triptych::scene {

// Returns the estimated distance from c to the power-8 Mandelbulb, in the units of c, or 0 inside.
// The result is bit-identical on every machine.
[[nodiscard]] double mandelbulb_distance(glm::dvec3 c);

}  // namespace triptych::scene
