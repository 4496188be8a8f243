#include "sphere_scenes.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

namespace triptych::reference {

scene::ParticleScene scene_of(scene::ParticleSet set, int width, int height, double fov_y_deg) {
  scene::ParticleScene scene;
  scene.particles = std::make_shared<const scene::ParticleSet>(std::move(set));
  scene.camera.fov_y_deg = fov_y_deg;
  scene.width = width;
  scene.height = height;
  return scene;
}

scene::ParticleSet set_of(const std::vector<std::array<double, 4>>& spheres) {
  scene::ParticleSet set;
  for (std::uint32_t id = 0; id < spheres.size(); ++id) {
    if (append(set, spheres[id], id)) set.rgba8.push_back((id + 1) * 2654435761U);
  }
  return set;
}

scene::ParticleSet random_set(std::uint64_t seed, int count, double smallest, double largest) {
  core::Random random(seed);
  std::vector<std::array<double, 4>> spheres;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    const double z = random.uniform(-1, 1);
    spheres.push_back({x, y, z, smallest * std::pow(largest / smallest, random.uniform())});
  }
  return set_of(spheres);
}

scene::ParticleSet shuffled(const scene::ParticleSet& set, std::uint64_t seed) {
  core::Random random(seed);
  scene::ParticleSet result = set;
  for (std::size_t i = set.count(); i > 1; --i) {
    const std::size_t j = random.bits() % i;
    std::swap(result.spheres[i - 1], result.spheres[j]);
    std::swap(result.ids[i - 1], result.ids[j]);
    std::swap(result.rgba8[i - 1], result.rgba8[j]);
  }
  return result;
}

VisibleSphere brute_force(const scene::ParticleScene& scene, const glm::dvec3& direction) {
  const scene::ParticleSet& set = *scene.particles;
  VisibleSphere shown;
  double nearest = shown.depth = std::numeric_limits<double>::infinity();
  for (std::size_t channel = 0; channel < 4; ++channel) {
    shown.rgba[channel] = scene.background[channel];
  }
  for (std::size_t i = 0; i < set.count(); ++i) {
    const glm::dvec3 centre =
        glm::dvec3(set.spheres[i][0], set.spheres[i][1], set.spheres[i][2]) - scene.camera.eye;
    const double radius = scene.radius(i);
    const double b = glm::dot(centre, direction);
    const glm::dvec3 foot = centre - b * direction;
    const double h_squared = radius * radius - glm::dot(foot, foot);
    if (h_squared < 0) continue;
    const double h = std::sqrt(h_squared);
    const double t = b - h > 0 ? b - h : b + h;
    if (!(t > 0) || t > nearest || (t == nearest && set.ids[i] > shown.id)) continue;
    nearest = t;
    shown.id = set.ids[i];
    shown.depth = t * glm::dot(direction, scene.camera.forward);
    const double light = scene.shading.ambient + scene.shading.diffuse * (h / radius);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      shown.rgba[channel] = (set.rgba8[i] >> (8 * channel) & 0xFFU) / 255.0 * light;
    }
    shown.rgba[3] = 1;
  }
  return shown;
}

glm::dvec3 ray_at(const scene::ParticleScene& scene, double x, double y) {
  const double tangent = std::tan(scene.camera.fov_y_deg * std::numbers::pi / 360);
  const double across = (2 * x - scene.width) / scene.height * tangent;
  const double upwards = (1 - 2 * y / scene.height) * tangent;
  return glm::normalize(scene.camera.forward + across * scene.camera.right() +
                        upwards * scene.camera.up);
}

}  // namespace triptych::reference
