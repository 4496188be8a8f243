// Draws point sprites. A second draw draws the spheres that exceed the device's largest point as
// screen-aligned quads.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "backends/vulkan/sprite_frames.hpp"
#include "backends/vulkan/techniques.hpp"
#include "scene/camera.hpp"

namespace triptych::vulkan_backend {
namespace {

// Returns whether a sphere may need a point that is larger than `largest` pixels. Its centre is at
// the distance d from the eye and at the angle φ from the view axis. Its silhouette extends by the
// angle α = asin(r/d) around the centre, where r is the radius. On the image plane at distance 1,
// the interval from φ − α to φ + α has the width
// tan(φ+α) − tan(φ−α) = sin 2α/(cos(φ+α)·cos(φ−α)).
bool may_be_large(const scene::ParticleScene& scene, const std::array<float, 4>& sphere,
                  double largest) {
  const scene::Camera& camera = scene.camera;
  const glm::dvec3 centre = glm::dvec3(sphere[0], sphere[1], sphere[2]) - camera.eye;
  const double d = glm::length(centre);
  const double r = static_cast<double>(sphere[3]);
  const double pixel = 2 * scene::tangent_of_half(camera.fov_y_deg) / scene.height;
  if (d <= 1.01 * r) return true;
  const double alpha = std::asin(r / d);
  const double phi = std::acos(std::clamp(glm::dot(centre, camera.forward) / d, -1.0, 1.0));
  const double corner = std::atan(pixel * std::hypot(scene.width, scene.height) / 2);
  if (phi - alpha > corner + 0.01) return false;  // outside the view
  const double far = std::cos(phi + alpha);
  const double wide = std::sin(2 * alpha) / (far * std::cos(phi - alpha));
  constexpr double safety = 0.98;  // allows for margins and for round-off in floats
  return phi + alpha > 1.5 || wide / pixel > safety * largest - 1;
}

// Returns runs of particles that contain all large particles. Runs that are close to each other are
// joined, because a draw call costs more than a few vertices.
std::vector<ParticleRun> large_runs(const scene::ParticleScene& scene,
                                    const technique::Arrangement& arrangement, double largest) {
  std::vector<ParticleRun> runs;
  for (std::uint32_t i = 0; i < arrangement.count(); ++i) {
    if (!may_be_large(scene, arrangement.sphere(i), largest)) continue;
    constexpr std::uint32_t longest_gap = 128;
    if (!runs.empty() && i - runs.back().begin < runs.back().count + longest_gap) {
      runs.back().count = i - runs.back().begin + 1;
    } else {
      runs.push_back({i, 1});
    }
  }
  return runs;
}

}  // namespace

std::unique_ptr<measure::Prepared> prepare_point(const Gpu& gpu, const Instance& instance,
                                                 const measure::ParticleWork& work) {
  using enum vk::ShaderStageFlagBits;
  const technique::Arrangement arrangement = technique::arrange(work.scene);
  SpriteTechnique technique;
  technique.draw.stages = {{eVertex, "point.vert.spv", "point_counting.vert.spv"}};
  technique.rest.emplace();
  technique.rest->stages = {{eVertex, "point_large.vert.spv", "point_large_counting.vert.spv"}};
  technique.rest->instanced = true;
  technique.rest->topology = vk::PrimitiveTopology::eTriangleStrip;
  technique.rest_runs =
      large_runs(work.scene, arrangement, static_cast<double>(largest_point(gpu)));
  return std::make_unique<SpriteFrames>(gpu, instance, work, arrangement, std::move(technique));
}

}  // namespace triptych::vulkan_backend
