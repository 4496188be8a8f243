#pragma once
#include <vector>

#include "backends/gl/api.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// Returns the number of pixels by which points must be enlarged on this device.
[[nodiscard]] double point_margin(const Api& gl);

// Returns the size of the largest point that the device can draw, in pixels.
[[nodiscard]] double largest_point(const Api& gl);

// Returns the cells of the arrangement, with a particle count of 0 for cells in which every sphere
// fits into the largest point. The second draw of `point` uses these cells. They stay valid because
// the camera does not move.
[[nodiscard]] std::vector<technique::Cell> cells_with_large_points(
    const Api& gl, const scene::ParticleScene& scene, const technique::Arrangement& arrangement);

}  // namespace triptych::gl_backend
