#pragma once
// Sets of particles for the tests in this folder.

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scene/particle_scene.hpp"
#include "tests/device/gl/gl_devices.hpp"

namespace triptych::gl_backend {

inline constexpr std::array<std::string_view, 8> particle_techniques{
    "quad_screen",  "quad_ray",         "quad_instanced", "quad_tess",
    "polygon_tess", "polygon_adaptive", "point",          "tiles"};

// Returns particles from x, y, z and r, with colours that depend on their indices.
inline std::shared_ptr<const scene::ParticleSet> set_of(
    const std::vector<std::array<double, 4>>& spheres) {
  scene::ParticleSet set;
  set.name = "here";
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    if (scene::append(set, spheres[i], i)) set.rgba8.push_back(0xFF000000U + 0x3377C1U * (i + 1));
  }
  set.hash = scene::particle_hash(set);
  return std::make_shared<const scene::ParticleSet>(std::move(set));
}

inline scene::ParticleScene scene_of(std::shared_ptr<const scene::ParticleSet> set) {
  scene::ParticleScene scene;
  scene.particles = std::move(set);
  scene.intensity_colours = scene::load_transfer_function("surfaces");
  scene.width = 45;
  scene.height = 38;
  scene.background = {0.1F, 0.2F, 0.3F, 1.0F};
  return scene;
}

inline scene::ParticleScene generated(std::string_view data,
                                      scene::ColourKind colour = scene::ColourKind::rgba8,
                                      std::string_view camera = "orbit_y:1/8") {
  scene::ParticleScene scene =
      scene_of(std::make_shared<const scene::ParticleSet>(scene::load_particles(data, colour)));
  scene.camera = scene::particle_camera(camera, *scene.particles, 60);
  return scene;
}

// Returns a scene seen from `eye` along -z.
inline scene::ParticleScene seen_from(const std::vector<std::array<double, 4>>& spheres,
                                      const glm::dvec3& eye, double fov_y_deg) {
  scene::ParticleScene scene = scene_of(set_of(spheres));
  scene.camera.eye = eye;
  scene.camera.fov_y_deg = fov_y_deg;
  scene.camera.near = scene::depth_scale(scene::bounding_box(*scene.particles), eye);
  return scene;
}

inline measure::Work particle_work(std::string_view technique, scene::ParticleScene scene,
                                   const technique::ParticleOptions& options = {}) {
  return {std::string(technique), measure::ParticleWork{std::move(scene), options}};
}

// Runs `check(technique)` for each technique that the device supports.
template <class Check>
void for_each_technique(const measure::Device& device, Check&& check) {
  const scene::ParticleScene scene = seen_from({{0, 0, -3, 1}}, {0, 0, 0}, 60);
  for (const std::string_view technique : particle_techniques) {
    if (device.unsupported(particle_work(technique, scene))) continue;
    SCOPED_TRACE(technique);
    check(technique);
  }
}

}  // namespace triptych::gl_backend
