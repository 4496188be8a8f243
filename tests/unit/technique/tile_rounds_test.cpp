#include "technique/particles/tile_rounds.hpp"

#include <gtest/gtest.h>

#include "scene/particle_generators.hpp"

namespace triptych::technique {
namespace {

scene::ParticleScene uniform(std::uint64_t count, double radius_scale) {
  scene::ParticleScene scene;
  scene.particles = std::make_shared<const scene::ParticleSet>(
      scene::generate_particles("uniform", count, scene::ColourKind::rgba8));
  scene.camera = scene::particle_camera("orbit_y:1/8", *scene.particles, 60);
  scene.width = scene.height = 256;
  scene.radius_scale = radius_scale;
  return scene;
}

void expect_all_cells_in_order(const TileRounds& rounds, const Arrangement& arrangement) {
  std::uint32_t next = 0;
  for (const TileRound& round : rounds.rounds) {
    EXPECT_EQ(round.first, next);
    EXPECT_GT(round.cells, 0U);
    next += round.cells;
  }
  EXPECT_EQ(next, arrangement.cells.size());
}

TEST(TileRounds, ContainEveryCellOnceWithinTheirLimits) {
  const scene::ParticleScene scene = uniform(60000, 8);
  const Arrangement arrangement = arrange(scene);
  for (const std::uint32_t most_cells : {1U, 7U, 65535U}) {
    const TileRounds rounds = tile_rounds(scene, arrangement, most_cells, 100000);
    expect_all_cells_in_order(rounds, arrangement);
    EXPECT_GT(rounds.rounds.size(), 1U);
    for (const TileRound& round : rounds.rounds) {
      EXPECT_LE(round.cells, most_cells);
    }
    EXPECT_LE(rounds.entries, 100000U);
  }
}

// Each of the 2,048 spheres around the eye covers every tile. An invocation of the pass that sorts
// spheres into tiles processes 32 spheres with one loop iteration per tile, so it needs 32 times as
// many iterations as the image has tiles.
TEST(TileRounds, SpheresAroundTheEyeMakeAsManyPassesAsTheyHaveTiles) {
  scene::ParticleScene scene = uniform(2048, 1000);
  scene.camera.eye = {0.5, 0.5, 0.5};
  const TileRounds small = tile_rounds(scene, arrange(scene), 65535, 1U << 24U);
  EXPECT_GE(small.passes, 32U * 256);
  EXPECT_LE(small.passes, 32U * 300);
  EXPECT_FALSE(passes_reason(small));
  scene.width = scene.height = 768;
  const TileRounds large = tile_rounds(scene, arrange(scene), 65535, 1U << 24U);
  EXPECT_GE(large.passes, 32U * 48 * 48);
  EXPECT_TRUE(passes_reason(large));
}

TEST(TileRounds, SmallSpheresNeedNoEntries) {
  const scene::ParticleScene scene = uniform(20000, 0.2);
  const TileRounds rounds = tile_rounds(scene, arrange(scene), 65535, 1000);
  EXPECT_EQ(rounds.entries, 0U);
  EXPECT_TRUE(rounds.small);
}

// If all spheres are large, the buffers for small spheres need not be cleared.
TEST(TileRounds, OnlyLargeSpheresMeansThatNoneIsSmall) {
  const scene::ParticleScene large = uniform(8, 2);
  EXPECT_FALSE(tile_rounds(large, arrange(large), 65535, 1U << 20U).small);
  // From this position, a sphere may be visible in only a few pixels, so it may count as small.
  scene::ParticleScene edge = large;
  edge.camera.eye = {5, 5, 5};
  EXPECT_TRUE(tile_rounds(edge, arrange(edge), 65535, 1U << 20U).small);
}

// If there are only a few large spheres, every pixel loops over the entries (the large spheres that
// reach its tile). Otherwise, a separate pass, tiles_resolve, finds the nearest entry for each
// pixel, in columns of eight pixels.
TEST(TileRounds, FewLargeSpheresAreDrawnDirectly) {
  for (const auto& [count, at_once] : {std::pair{8U, true}, {200U, false}, {60000U, false}}) {
    const scene::ParticleScene scene = uniform(count, 2);
    const TileRounds rounds = tile_rounds(scene, arrange(scene), 65535, 1U << 20U);
    EXPECT_EQ(rounds.at_once, at_once) << count;
    EXPECT_EQ(rounds.resolved(), !at_once) << count;
    EXPECT_EQ(rounds.spheres() & 6, at_once ? 2 : 6) << count;
  }
}

// llvmpipe and lavapipe limit the iterations of a loop. A tile's loop over its entries must stay
// below that limit.
TEST(TileRounds, ARoundHasAtMostAsManyLargeSpheresAsALoopAllows) {
  scene::ParticleScene scene = uniform(200000, 1000);
  scene.width = scene.height = 16;
  const Arrangement arrangement = arrange(scene);
  for (const TileRound& round : tile_rounds(scene, arrangement, 65535, 1U << 24U).rounds) {
    std::uint64_t spheres = 0;
    for (std::uint32_t i = round.first; i < round.first + round.cells; ++i) {
      spheres += arrangement.cells[i].count;
    }
    EXPECT_LE(spheres, most_large_spheres);
  }
}

TEST(TileRounds, ASphereAroundTheEyeMayOverlapEveryTile) {
  scene::ParticleScene scene = uniform(1, 1000);
  scene.camera.eye = {5, 5, 5};
  EXPECT_EQ(tile_rounds(scene, arrange(scene), 65535, 1).entries, 256U);
}

TEST(TileRounds, AreEmptyWithoutParticles) {
  scene::ParticleScene scene = uniform(1, 1);
  scene.particles = std::make_shared<const scene::ParticleSet>();
  EXPECT_TRUE(tile_rounds(scene, arrange(scene), 65535, 1).rounds.empty());
}

}  // namespace
}  // namespace triptych::technique
