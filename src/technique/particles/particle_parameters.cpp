#include "technique/particles/particle_parameters.hpp"

#include "scene/camera.hpp"

namespace triptych::technique {
namespace {

float nearest(double value) {
  return static_cast<float>(value);
}

// This function must not be inlined, because GCC 12 vectorises adjacent calls in a way that omits
// the rounding to float and back. Every result would then be 0.
[[gnu::noinline]] float rest(double value) {
  return static_cast<float>(value - static_cast<double>(nearest(value)));
}

std::array<float, 4> nearest(const glm::dvec3& v, float w) {
  return {nearest(v.x), nearest(v.y), nearest(v.z), w};
}

std::array<float, 4> rest(const glm::dvec3& v, float w = 0) {
  return {rest(v.x), rest(v.y), rest(v.z), w};
}

}  // namespace

ParticleParameters particle_parameters(const scene::ParticleScene& scene,
                                       const ParticleOptions& options, std::size_t particles,
                                       std::size_t cells) {
  const scene::Camera& camera = scene.camera;
  const double half_y = scene::tangent_of_half(camera.fov_y_deg);
  const double half_x = half_y * scene.width / scene.height;
  const float sprite_scale = options.fault == ParticleFault::small_sprite ? 0.99F : 1.0F;
  const float view_scale = options.fault == ParticleFault::culled_visible ? 0.5F : 1.0F;
  return {
      .eye = nearest(camera.eye, nearest(camera.near)),
      .eye_rest = rest(camera.eye, sprite_scale),
      .right = nearest(camera.right(), nearest(0.5 / half_x)),
      .right_rest = rest(camera.right()),
      .up = nearest(camera.up, nearest(0.5 / half_y)),
      .up_rest = rest(camera.up),
      .forward = nearest(camera.forward, view_scale),
      .forward_rest = rest(camera.forward),
      .plane = {nearest(half_x), nearest(half_y), nearest(2 * half_x / scene.width),
                nearest(2 * half_y / scene.height)},
      .shading = {nearest(scene.shading.ambient), nearest(scene.shading.diffuse), 0, 0},
      .background = scene.background,
      .viewport = {scene.width, scene.height, options.corners,
                   static_cast<std::int32_t>(scene.particles->colour)},
      .counts = {static_cast<std::uint32_t>(particles), static_cast<std::uint32_t>(cells), 0, 0},
  };
}

ParticleParameters particle_parameters(const scene::ParticleScene& scene,
                                       const ParticleOptions& options,
                                       const Arrangement& arrangement) {
  return particle_parameters(scene, options, arrangement.count(), arrangement.cells.size());
}

}  // namespace triptych::technique
