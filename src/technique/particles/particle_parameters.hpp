#pragma once
// The parameters of the shaders and kernels of every API.

#include <array>
#include <cstddef>
#include <cstdint>

#include "scene/particle_scene.hpp"
#include "technique/particles/arrangement.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::technique {

// The layout is the same as in particles/parameters.glsl (std140) and particle_parameters.cl. A
// double is stored as two floats: the nearest float, and the remainder (see tri_along_axis in
// portable/sphere_math.h).
struct ParticleParameters {
  std::array<float, 4> eye;       // xyz: position in world space; w: near; depth = near/distance
  std::array<float, 4> eye_rest;  // w: sprite scale, 1 unless ParticleFault::small_sprite
  std::array<float, 4> right;     // camera axes; w of right: 1/(width of the image plane at z = 1)
  std::array<float, 4> right_rest;
  std::array<float, 4> up;  // w: 1/(height of the image plane)
  std::array<float, 4> up_rest;
  std::array<float, 4> forward;  // w: share of the view used for culling: 1, or ½ with a fault
  std::array<float, 4> forward_rest;
  // The image plane z = 1. The ray of pixel (x, y), where y = 0 is the top row, intersects the
  // plane at
  //   sx = (x + ½)·plane.z − plane.x,   sy = plane.y − (y + ½)·plane.w.
  std::array<float, 4> plane;            // half extents x, y; pixel size x, y
  std::array<float, 4> shading;          // ambient, diffuse, 0, 0
  std::array<float, 4> background;       // premultiplied RGBA
  std::array<std::int32_t, 4> viewport;  // width, height, corners, colour format
  std::array<std::uint32_t, 4> counts;   // particles, cells, 0, 0
};
static_assert(sizeof(ParticleParameters) == std::size_t{13} * 16);
static_assert(offsetof(ParticleParameters, plane) == std::size_t{8} * 16);

// Returns the parameters for an arrangement with this many particles and cells.
[[nodiscard]] ParticleParameters particle_parameters(const scene::ParticleScene& scene,
                                                     const ParticleOptions& options,
                                                     std::size_t particles, std::size_t cells);
[[nodiscard]] ParticleParameters particle_parameters(const scene::ParticleScene& scene,
                                                     const ParticleOptions& options,
                                                     const Arrangement& arrangement);

}  // namespace triptych::technique
