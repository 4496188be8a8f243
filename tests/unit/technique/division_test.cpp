#include "technique/particles/division.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/particle_generators.hpp"

namespace triptych::technique {
namespace {

constexpr std::size_t per_cell = 512;

scene::ParticleScene scene_without_camera(scene::ParticleSet set) {
  scene::ParticleScene scene;
  scene.particles = std::make_shared<const scene::ParticleSet>(std::move(set));
  return scene;
}

scene::ParticleSet generated_set(std::string_view name, std::uint64_t count) {
  return scene::generate_particles(name, count, scene::ColourKind::rgba8);
}

std::vector<std::size_t> counts_of(const scene::ParticleScene& scene, const Division& division) {
  std::vector<std::size_t> counts(division.parts());
  for (std::uint32_t place = 0; place < scene.particles->count(); ++place) {
    ++counts.at(division.part_of(place));
  }
  return counts;
}

// The wall consists of 316 × 316 spheres, and 900,144 spheres are behind it. Without division, the
// grid cells that contain spheres of the wall would also contain 71,507 of the spheres behind it.
TEST(Division, AWallIsSeparatedFromSpheresBehindIt) {
  constexpr std::size_t wall = 316 * 316;
  const scene::ParticleScene scene = scene_without_camera(generated_set("hidden", 1'000'000));
  const Division division(scene, per_cell);
  const std::vector<std::size_t> counts = counts_of(scene, division);
  std::vector<bool> shows_wall(division.parts());
  for (std::uint32_t place = 0; place < wall; ++place) shows_wall[division.part_of(place)] = true;
  std::size_t with_wall = 0;
  for (std::size_t part = 0; part < counts.size(); ++part) {
    if (shows_wall[part]) with_wall += counts[part];
  }
  EXPECT_LT(with_wall, wall * 11 / 10);
}

// A cell of evenly distributed particles is divided only if it contains at least 1.5 times the
// average number of particles. Here, cells contain 512 ± 23 particles, so none of them is divided.
TEST(Division, EvenlySpreadParticlesStayInTheCellsOfTheGrid) {
  const scene::ParticleScene scene =
      scene_without_camera(generated_set("uniform", 13 * 13 * 13 * 512));
  const Grid grid(*scene.particles, per_cell);
  const Division division(scene, per_cell);
  EXPECT_EQ(division.parts(), grid.cells() + 1);
}

// Because of a single distant particle, the grid is so coarse that all other particles fall into
// one cell.
TEST(Division, AFarParticleDoesNotPreventDivision) {
  scene::ParticleSet set = generated_set("uniform", 20'000);
  set.spheres[777][0] = 1e5F;
  const scene::ParticleScene scene = scene_without_camera(std::move(set));
  const Division division(scene, per_cell);
  for (const std::size_t count : counts_of(scene, division)) EXPECT_LT(count, 2 * per_cell);
}

TEST(Division, CoincidentCentresAreInOnePart) {
  const scene::ParticleScene scene = scene_without_camera(generated_set("coincident", 40'000));
  const Division division(scene, per_cell);
  EXPECT_GT(division.parts(), 20U);
  std::map<std::array<float, 3>, std::uint32_t> part_at;
  for (std::uint32_t place = 0; place < scene.particles->count(); ++place) {
    const auto& [x, y, z, r] = scene.particles->spheres[place];
    const std::uint32_t part = division.part_of(place);
    EXPECT_EQ(part_at.try_emplace({x, y, z}, part).first->second, part);
  }
  EXPECT_EQ(part_at.size(), 5000U);
}

TEST(Division, APileCannotBeDivided) {
  scene::ParticleSet set;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    ASSERT_TRUE(scene::append(set, {1, 2, 3, 0.5}, i));
    set.rgba8.push_back(i);
  }
  const scene::ParticleScene scene = scene_without_camera(std::move(set));
  const Division division(scene, per_cell);
  const std::vector<std::size_t> counts = counts_of(scene, division);
  EXPECT_EQ(*std::ranges::max_element(counts), 5000U);
}

}  // namespace
}  // namespace triptych::technique
