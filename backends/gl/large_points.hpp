#pragma once
#include <vector>

#include "backends/gl/api.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// Returns the number of pixels that must be added to the size of a point so that this device draws
// at least the intended square.
[[nodiscard]] double point_margin(const Api& gl);

// Returns the size of the largest point that the device can draw, in pixels.
[[nodiscard]] double largest_point(const Api& gl);

// Returns the cells of the arrangement, which are ranges of neighbouring particles. Cells in which
// every sphere fits into the largest point get a particle count of 0. In a second draw, the
// technique `point` draws the large spheres of the other cells as quads. The result stays valid
// because the camera does not move.
[[nodiscard]] std::vector<technique::Cell> cells_with_large_points(
    const Api& gl, const scene::ParticleScene& scene, const technique::Arrangement& arrangement);

}  // namespace triptych::gl_backend
