#pragma once
// Scenes of spheres for the tests in this folder, and comparisons of their images.

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reference/spheres.hpp"
#include "scene/particle_generators.hpp"
#include "scene/particle_scene.hpp"
#include "suites/particles/tolerance.hpp"
#include "tests/device/opencl/opencl_devices.hpp"

namespace triptych::opencl_backend {

inline constexpr std::array<std::string_view, 5> particle_techniques{
    "quad_screen", "quad_instanced", "polygon_tess", "polygon_adaptive", "tiles"};

using Spheres = std::vector<std::array<double, 4>>;

inline scene::ParticleScene scene_of(scene::ParticleSet set, const scene::Camera& camera, int width,
                                     int height) {
  scene::ParticleScene scene;
  scene.camera = camera;
  scene.camera.near = scene::depth_scale(scene::bounding_box(set), camera.eye);
  scene.particles = std::make_shared<const scene::ParticleSet>(std::move(set));
  scene.intensity_colours = scene::load_transfer_function("surfaces");
  scene.width = width;
  scene.height = height;
  scene.background = {0.1F, 0.2F, 0.3F, 1.0F};
  return scene;
}

// Returns a scene seen from `eye` along -z.
inline scene::ParticleScene seen_from(const Spheres& spheres, const glm::dvec3& eye,
                                      double fov_y_deg, int width = 97, int height = 83) {
  scene::ParticleSet set;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    if (scene::append(set, spheres[i], i)) set.rgba8.push_back(0xFF0040A0U + 0x10203U * i);
  }
  scene::Camera camera;
  camera.eye = eye;
  camera.fov_y_deg = fov_y_deg;
  return scene_of(std::move(set), camera, width, height);
}

inline scene::ParticleScene generated(std::string_view generator, std::uint64_t count,
                                      std::string_view camera, int side = 97) {
  scene::ParticleSet set = scene::generate_particles(generator, count, scene::ColourKind::rgba8);
  const scene::Camera seen = scene::particle_camera(camera, set, 60);
  return scene_of(std::move(set), seen, side, side);
}

inline measure::Work make_work(std::string_view technique, scene::ParticleScene scene,
                               const technique::ParticleOptions& options = {}) {
  return {std::string(technique), measure::ParticleWork{std::move(scene), options}};
}

inline record::Counts counters(measure::Device& device, const measure::Work& work) {
  return device.prepare(work)->frame(measure::Purpose::counters).counts;
}

inline reference::SphereTruth truth_of(const scene::ParticleScene& scene) {
  return reference::render_spheres(
      scene, particles_suite::error_model(scene, technique::ComputedAt::pixel));
}

// Returns the number of wrong pixels. A pixel is wrong if its colour differs from the reference
// image by more than the bound. A pixel for which the reference renderer is certain which sphere is
// visible is also wrong if its id or depth differs.
inline int wrong_pixels(const core::Image& image, const reference::SphereTruth& truth) {
  int wrong = 0;
  for (std::size_t i = 0; i < truth.ids.size(); ++i) {
    bool right = true;
    for (std::size_t c = 4 * i; c < 4 * i + 4; ++c) {
      right = right &&
              std::abs(static_cast<double>(image.rgba.at(c)) - truth.rgba[c]) <= truth.bound[i];
    }
    if (truth.certain[i] != 0) {
      const double z = static_cast<double>(image.depth.at(i));
      right = right && image.ids.at(i) == truth.ids[i] &&
              (z == truth.depth[i] || std::abs(z - truth.depth[i]) <= truth.depth_bound[i]);
    }
    wrong += right ? 0 : 1;
  }
  return wrong;
}

}  // namespace triptych::opencl_backend
