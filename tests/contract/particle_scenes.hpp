#pragma once
// Scenes of spheres for the contract tests, and the checks of their images.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "accuracy/image_metrics.hpp"
#include "core/random.hpp"
#include "reference/spheres.hpp"
#include "scene/particle_generators.hpp"
#include "suites/particles/tolerance.hpp"
#include "technique/catalogue.hpp"
#include "under_test.hpp"

namespace triptych::contract {

using measure::ParticleWork;

inline std::vector<std::string> particle_techniques() {
  std::vector<std::string> ids;
  for (const technique::Technique& each : technique::catalogue()) {
    if (each.suite == "particles") ids.push_back(each.id);
  }
  return ids;
}

inline scene::ParticleSet particles_of(const std::vector<std::array<double, 4>>& spheres) {
  scene::ParticleSet set;
  set.name = "by hand";
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    if (!scene::append(set, spheres[i], i)) continue;
    set.rgba8.push_back(0xFF000000U | (0x3B7A91U * (i + 1) & 0xFFFFFFU));
  }
  return set;
}

using scene::camera_looking_at;

inline ParticleWork particle_work(scene::ParticleSet set, const scene::Camera& camera, int width,
                                  int height) {
  ParticleWork work;
  work.scene.camera = camera;
  work.scene.camera.near = scene::depth_scale(scene::bounding_box(set), camera.eye);
  work.scene.particles = std::make_shared<const scene::ParticleSet>(std::move(set));
  work.scene.intensity_colours = scene::load_transfer_function("haze");
  work.scene.width = width;
  work.scene.height = height;
  return work;
}

inline ParticleWork generated_work(std::string_view generator, std::uint64_t count,
                                   std::string_view camera, int side,
                                   scene::ColourKind colour = scene::ColourKind::rgba8) {
  scene::ParticleSet set = scene::generate_particles(generator, count, colour);
  const scene::Camera seen = scene::particle_camera(camera, set, 60);
  return particle_work(std::move(set), seen, side, side);
}

inline reference::SphereTruth truth_of(const ParticleWork& work) {
  return reference::render_spheres(work.scene,
                                   particles_suite::error_model(work.scene, work.options.ray));
}

// Returns a wall, which is the front of a huge sphere, and small spheres that are half embedded in
// it. Once the wall is drawn, the front of each small sphere is nearer than the surface in its
// tile, but its back is farther away than that surface.
inline ParticleWork studded_wall() {
  std::vector<std::array<double, 4>> spheres{{0, 0, -1000, 1000}};
  core::Random random(11);
  for (int i = 0; i < 20000; ++i) {
    spheres.push_back({random.uniform(-4, 4), random.uniform(-4, 4), 0, 0.1});
  }
  return particle_work(particles_of(spheres), camera_looking_at({0, 0, 5}, {0, 0, 0}, 60), 96, 96);
}

// Checks the colours, and every id and depth that the reference renderer can determine with
// certainty.
inline void expect_true(const core::Image& image, const reference::SphereTruth& truth) {
  const auto result = accuracy::compare(image, truth.image(), truth.bound_image());
  const auto& first = result.first_wrong;
  EXPECT_TRUE(result.within_bound())
      << result.wrong_ids << " wrong ids, " << result.wrong_depths << " wrong depths, "
      << result.over_bound << " colours over the bound, " << result.non_finite
      << " not finite; first at " << first.x << ' ' << first.y << ": id " << first.id
      << " expected " << first.expected_id << ", depth " << first.depth << " expected "
      << first.expected_depth << " +- " << first.bound << "; worst colour at " << result.worst.x
      << ' ' << result.worst.y << ": " << result.worst.error << " allowed " << result.worst.bound;
}

// Runs `body` for every technique that the device supports.
template <typename Body>
void with_every_technique(measure::Device& device, const ParticleWork& work, const Body& body) {
  for (const std::string& technique : particle_techniques()) {
    SCOPED_TRACE(technique);
    const measure::Work whole{.technique = technique, .scene = work};
    if (device.unsupported(whole)) continue;
    body(whole);
  }
}

}  // namespace triptych::contract
