#pragma once
// Particle scenes that are made by hand, and a renderer that tries every sphere for every pixel.

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

// The view is from the origin along −z.
[[nodiscard]] scene::ParticleScene scene_of(scene::ParticleSet set, int width, int height,
                                            double fov_y_deg);

// Centre and radius; the id is the index, the colour a hash of it.
[[nodiscard]] scene::ParticleSet set_of(const std::vector<std::array<double, 4>>& spheres);

// Spheres in the cube [−1, 1]³ with log-uniform radii.
[[nodiscard]] scene::ParticleSet random_set(std::uint64_t seed, int count, double smallest,
                                            double largest);

// The same particles in another order, with their ids and colours.
[[nodiscard]] scene::ParticleSet shuffled(const scene::ParticleSet& set, std::uint64_t seed);

struct Shown {
  std::uint32_t id = core::Image::no_particle;
  double depth = 0;
  std::array<double, 4> rgba{};
};

// The result for a ray in this direction, found by trying every sphere.
[[nodiscard]] Shown brute_force(const scene::ParticleScene& scene, const glm::dvec3& direction);

// The ray through a position in the image, in pixels from its upper left corner.
[[nodiscard]] glm::dvec3 ray_at(const scene::ParticleScene& scene, double x, double y);

}  // namespace triptych::reference
