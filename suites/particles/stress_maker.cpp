#include "suites/particles/stress_maker.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "scene/camera.hpp"
#include "scene/particle_colours.hpp"
#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

glm::dvec3 oblique() {
  return glm::normalize(glm::dvec3{1, 0.5, 2});
}

StressMaker::StressMaker(scene::ColourKind colour, const scene::Camera& camera, int width,
                         int height) {
  scene_.particles.colour = colour;
  scene_.camera = camera;
  scene_.width = width;
  scene_.height = height;
}

void StressMaker::add(const glm::dvec3& centre, double radius) {
  const std::uint32_t index = next_++;
  if (!scene::append(scene_.particles, {centre.x, centre.y, centre.z, radius}, index)) return;
  // The hue advances by the golden ratio, so that successive particles have very different colours.
  const double turns = std::fmod(index * std::numbers::phi, 1.0);
  scene::append_colour(scene_.particles, scene::hue_colour(turns), turns);
}

void StressMaker::add_at(double x, double y, double depth, double radius_px) {
  add(place(x, y, depth), radius_px * pixel() * depth);
}

glm::dvec3 StressMaker::place(double x, double y, double depth) const {
  const scene::Camera& camera = scene_.camera;
  const double across = (x - 0.5 * scene_.width) * pixel();
  const double upwards = (0.5 * scene_.height - y) * pixel();
  return camera.eye + depth * (camera.forward + across * camera.right() + upwards * camera.up);
}

double StressMaker::pixel() const {
  return 2 * scene::tangent_of_half(scene_.camera.fov_y_deg) / scene_.height;
}

StressScene StressMaker::take() {
  scene_.camera.near = scene::depth_scale(scene::bounding_box(scene_.particles), scene_.camera.eye);
  return std::move(scene_);
}

StressScene stress_of(scene::ParticleSet set, const scene::Camera& camera, int width, int height) {
  StressScene scene{
      .particles = std::move(set), .camera = camera, .width = width, .height = height};
  scene.camera.near = scene::depth_scale(scene::bounding_box(scene.particles), camera.eye);
  return scene;
}

}  // namespace triptych::particles_suite
