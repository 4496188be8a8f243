#pragma once
#include <vector>

#include "backends/gl/api.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// The number of pixels to add to the size of a point on this device.
[[nodiscard]] double point_margin(const Api& gl);

// The largest point that the device draws, in pixels.
[[nodiscard]] double largest_point(const Api& gl);

// The cells of the arrangement with empty cells wherever no sphere may need a larger point. The
// second draw of `point` uses these, because the camera does not move.
[[nodiscard]] std::vector<technique::Cell> cells_with_large_points(
    const Api& gl, const scene::ParticleScene& scene, const technique::Arrangement& arrangement);

}  // namespace triptych::gl_backend
