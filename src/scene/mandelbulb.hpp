#pragma once
#include <glm/vec3.hpp>

namespace triptych::scene {

// The estimated distance from c to the power-8 Mandelbulb, in the units of c; 0 inside. It has the
// same bits on every machine.
[[nodiscard]] double mandelbulb_distance(glm::dvec3 c);

}  // namespace triptych::scene
