#include "technique/particles/arrangement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "core/random.hpp"
#include "scene/particle_generators.hpp"

namespace triptych::technique {
namespace {

scene::ParticleScene scene_of(scene::ParticleSet set) {
  scene::ParticleScene scene;
  scene.camera = scene::particle_camera("orbit_y:1/8", set, 60);
  scene.particles = std::make_shared<const scene::ParticleSet>(std::move(set));
  return scene;
}

scene::ParticleScene generated(std::string_view name, std::uint64_t count) {
  return scene_of(scene::generate_particles(name, count, scene::ColourKind::rgba8));
}

TEST(Arrangement, HoldsEveryParticleOnce) {
  const scene::ParticleScene scene = generated("uniform", 20000);
  const Arrangement arranged = arrange(scene);
  ASSERT_EQ(arranged.count(), 20000U);
  std::vector<std::uint32_t> ids = arranged.ids;
  std::ranges::sort(ids);
  for (std::uint32_t i = 0; i < ids.size(); ++i) ASSERT_EQ(ids[i], i);
  for (std::size_t k = 0; k < arranged.count(); ++k) {
    ASSERT_EQ(arranged.spheres[k], scene.particles->spheres[arranged.ids[k]]);
    ASSERT_EQ(arranged.rgba8[k], scene.particles->rgba8[arranged.ids[k]]);
  }
}

TEST(Arrangement, CellsFollowOneAnotherAndEncloseTheirSpheres) {
  const Arrangement arranged = arrange(generated("droplets", 30000));
  EXPECT_GT(arranged.cells.size(), 20U);
  std::uint32_t next = 0;
  for (const Cell& cell : arranged.cells) {
    EXPECT_EQ(cell.begin, next);
    EXPECT_GT(cell.count, 0U);
    next += cell.count;
    for (std::uint32_t k = cell.begin; k < next; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double centre = arranged.spheres[k][axis];
        const double radius = arranged.spheres[k][3];
        ASSERT_LE(cell.lo[axis], centre - radius);
        ASSERT_GE(cell.hi[axis], centre + radius);
      }
    }
  }
  EXPECT_EQ(next, arranged.count());
}

TEST(Arrangement, CellsComeFrontToBackAndIdsAscend) {
  const scene::ParticleScene scene = generated("uniform", 20000);
  const Arrangement arranged = arrange(scene);
  double farthest = 0;
  for (const Cell& cell : arranged.cells) {
    const glm::dvec3 lo{cell.lo[0], cell.lo[1], cell.lo[2]};
    const glm::dvec3 hi{cell.hi[0], cell.hi[1], cell.hi[2]};
    const glm::dvec3& eye = scene.camera.eye;
    const double distance = glm::distance(eye, glm::clamp(eye, lo, hi));
    EXPECT_GE(distance, farthest);
    farthest = distance;
    const auto begin = arranged.ids.begin() + cell.begin;
    EXPECT_TRUE(std::is_sorted(begin, begin + cell.count));
  }
}

TEST(Arrangement, DoesNotDependOnTheOrderOfTheSet) {
  scene::ParticleScene scene = generated("coincident", 5000);
  const Arrangement before = arrange(scene);
  scene::ParticleSet shuffled = *scene.particles;
  core::Random random(3);
  for (std::size_t i = shuffled.count() - 1; i > 0; --i) {
    const std::size_t j = random.bits() % (i + 1);
    std::swap(shuffled.spheres[i], shuffled.spheres[j]);
    std::swap(shuffled.ids[i], shuffled.ids[j]);
    std::swap(shuffled.rgba8[i], shuffled.rgba8[j]);
  }
  scene.particles = std::make_shared<const scene::ParticleSet>(std::move(shuffled));
  const Arrangement after = arrange(scene);
  EXPECT_EQ(after.ids, before.ids);
  EXPECT_EQ(after.spheres, before.spheres);
  EXPECT_EQ(after.rgba8, before.rgba8);
}

// A sphere that would make its cell's box too large to be culled is put apart.
TEST(Arrangement, ALargeSphereGrowsNoCell) {
  scene::ParticleSet set = scene::generate_particles("uniform", 20000, scene::ColourKind::rgba8);
  set.spheres[777][3] = 20;
  const Arrangement arranged = arrange(scene_of(std::move(set)));
  EXPECT_EQ(arranged.cells.front().count, 1U);
  EXPECT_EQ(arranged.ids.front(), 777U);
  for (std::size_t i = 1; i < arranged.cells.size(); ++i) {
    EXPECT_LT(arranged.cells[i].hi[0] - arranged.cells[i].lo[0], 8);
  }
}

TEST(Arrangement, ACrowdedPlaceIsDivided) {
  scene::ParticleSet set;
  for (std::uint32_t i = 0; i < 10000; ++i) {
    ASSERT_TRUE(scene::append(set, {1, 2, 3, 0.5}, i));
    set.rgba8.push_back(i);
  }
  const Arrangement arranged = arrange(scene_of(std::move(set)));
  EXPECT_EQ(arranged.count(), 10000U);
  EXPECT_TRUE(std::ranges::is_sorted(arranged.ids));
  for (const Cell& cell : arranged.cells) EXPECT_LE(cell.count, 4 * particles_per_cell);
}

TEST(Arrangement, RadiiAreScaledAsTheSceneSays) {
  scene::ParticleScene scene = generated("uniform", 100);
  scene.radius_scale = 1.5;
  const Arrangement arranged = arrange(scene);
  for (std::size_t k = 0; k < arranged.count(); ++k) {
    EXPECT_EQ(arranged.spheres[k][3], scene.radius(arranged.ids[k]));
  }
}

TEST(Arrangement, NothingIsArrangedToNothing) {
  EXPECT_EQ(arrange(scene_of({})).count(), 0U);
  EXPECT_TRUE(arrange(scene_of({})).cells.empty());
}

}  // namespace
}  // namespace triptych::technique
