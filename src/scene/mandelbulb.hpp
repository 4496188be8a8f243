#pragma once
#include <glm/vec3.hpp>

namespace triptych::scene {

// Estimated distance from c to the power-8 Mandelbulb, in the units of c; 0 inside. The same bits
// everywhere.
[[nodiscard]] double mandelbulb_distance(glm::dvec3 c);

}  // namespace triptych::scene
