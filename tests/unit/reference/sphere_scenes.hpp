#pragma once
// Particle scenes built by hand, and a renderer that tests every sphere for every pixel.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/random.hpp"
#include "reference/spheres.hpp"
#include "scene/particle_scene.hpp"

namespace triptych::reference {

// Returns a scene viewed from the origin along −z.
[[nodiscard]] scene::ParticleScene scene_of(scene::ParticleSet set, int width, int height,
                                            double fov_y_deg);

// Each sphere is given as centre and radius. Its id is its index, and its colour is a hash of the
// id.
[[nodiscard]] scene::ParticleSet set_of(const std::vector<std::array<double, 4>>& spheres);

// Returns spheres in the cube [−1, 1]³ with log-uniformly distributed radii.
[[nodiscard]] scene::ParticleSet random_set(std::uint64_t seed, int count, double smallest,
                                            double largest);

// Returns the same particles, with their ids and colours, in random order.
[[nodiscard]] scene::ParticleSet shuffled(const scene::ParticleSet& set, std::uint64_t seed);

struct VisibleSphere {
  std::uint32_t id = core::Image::no_particle;
  double depth = 0;
  std::array<double, 4> rgba{};
};

// Returns the sphere that is visible in this direction, found by testing every sphere.
[[nodiscard]] VisibleSphere brute_force(const scene::ParticleScene& scene,
                                        const glm::dvec3& direction);

// Returns the direction of the ray through a position, given in pixels from the upper left corner
// of the image.
[[nodiscard]] glm::dvec3 ray_at(const scene::ParticleScene& scene, double x, double y);

}  // namespace triptych::reference
