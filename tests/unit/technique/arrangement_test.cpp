#include "technique/particles/arrangement.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <vector>

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

std::vector<std::uint32_t> ids_of(const Arrangement& arranged) {
  std::vector<std::uint32_t> ids;
  for (std::size_t k = 0; k < arranged.count(); ++k) ids.push_back(arranged.id(k));
  return ids;
}

// Returns a property of all particles, joined from pieces of the size in which a device receives
// them.
std::vector<std::byte> gathered(const Arrangement& arranged, Property property,
                                std::size_t piece_bytes) {
  std::vector<std::byte> all(arranged.bytes(property));
  for (std::size_t begin = 0; begin < all.size(); begin += piece_bytes) {
    const std::size_t size = std::min(piece_bytes, all.size() - begin);
    arranged.copy(property, begin, std::span(all).subspan(begin, size));
  }
  return all;
}

std::vector<std::byte> gathered(const Arrangement& arranged, Property property) {
  return gathered(arranged, property, arranged.bytes(property));
}

// Returns the bytes of value(i) for all particles in the order of the arrangement, where i is the
// particle's index in the set.
template <typename Value>
std::vector<std::byte> expected(const Arrangement& arranged, const Value& value) {
  std::vector<decltype(value(0U))> values;
  for (const std::uint32_t place : arranged.order) values.push_back(value(place));
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

TEST(Arrangement, ContainsEveryParticleOnce) {
  const scene::ParticleScene scene = generated("uniform", 20000);
  const Arrangement arranged = arrange(scene);
  ASSERT_EQ(arranged.count(), 20000U);
  for (std::size_t k = 0; k < arranged.count(); ++k) {
    ASSERT_EQ(arranged.sphere(k), scene.particles->spheres[arranged.id(k)]);
  }
  std::vector<std::uint32_t> ids = ids_of(arranged);
  std::ranges::sort(ids);
  for (std::uint32_t i = 0; i < ids.size(); ++i) ASSERT_EQ(ids[i], i);
}

class ArrangementColour : public testing::TestWithParam<scene::ColourKind> {};

TEST_P(ArrangementColour, PropertiesAreThoseOfTheSetInOrder) {
  scene::ParticleScene scene = scene_of(scene::generate_particles("uniform", 3001, GetParam()));
  scene.radius_scale = 1.5;
  const scene::ParticleSet& set = *scene.particles;
  const Arrangement arranged = arrange(scene);
  EXPECT_EQ(gathered(arranged, Property::id),
            expected(arranged, [&](std::uint32_t i) { return set.ids[i]; }));
  EXPECT_EQ(gathered(arranged, Property::sphere), expected(arranged, [&](std::uint32_t i) {
              const auto& [x, y, z, r] = set.spheres[i];
              return std::array{x, y, z, scene.radius(i)};
            }));
  const std::vector<std::byte> colours = gathered(arranged, Property::colour);
  switch (GetParam()) {
    case scene::ColourKind::rgba8:
      EXPECT_EQ(colours, expected(arranged, [&](std::uint32_t i) { return set.rgba8[i]; }));
      break;
    case scene::ColourKind::rgba32:
      EXPECT_EQ(colours, expected(arranged, [&](std::uint32_t i) { return set.rgba32[i]; }));
      break;
    case scene::ColourKind::intensity:
      EXPECT_EQ(colours, expected(arranged, [&](std::uint32_t i) { return set.intensity[i]; }));
      break;
  }
}

TEST_P(ArrangementColour, PropertiesInPiecesMatchTheWhole) {
  const Arrangement arranged =
      arrange(scene_of(scene::generate_particles("uniform", 3001, GetParam())));
  for (const Property property : {Property::sphere, Property::colour, Property::id}) {
    const std::vector<std::byte> whole = gathered(arranged, property);
    EXPECT_EQ(whole.size(), 3001 * arranged.element_bytes(property));
    for (const std::size_t piece_bytes : {16U, 4096U}) {
      EXPECT_EQ(gathered(arranged, property, piece_bytes), whole);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryColour, ArrangementColour,
                         testing::Values(scene::ColourKind::rgba8, scene::ColourKind::rgba32,
                                         scene::ColourKind::intensity),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

TEST(Arrangement, CellsAreContiguousAndEncloseTheirSpheres) {
  const Arrangement arranged = arrange(generated("droplets", 30000));
  EXPECT_GT(arranged.cells.size(), 20U);
  std::uint32_t next = 0;
  for (const Cell& cell : arranged.cells) {
    EXPECT_EQ(cell.begin, next);
    EXPECT_GT(cell.count, 0U);
    next += cell.count;
    for (std::uint32_t k = cell.begin; k < next; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double centre = arranged.sphere(k)[axis];
        const double radius = arranged.sphere(k)[3];
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
  const std::vector<std::uint32_t> ids = ids_of(arranged);
  double farthest = 0;
  for (const Cell& cell : arranged.cells) {
    const glm::dvec3 lo{cell.lo[0], cell.lo[1], cell.lo[2]};
    const glm::dvec3 hi{cell.hi[0], cell.hi[1], cell.hi[2]};
    const glm::dvec3& eye = scene.camera.eye;
    const double distance = glm::distance(eye, glm::clamp(eye, lo, hi));
    EXPECT_GE(distance, farthest);
    farthest = distance;
    const auto begin = ids.begin() + cell.begin;
    EXPECT_TRUE(std::is_sorted(begin, begin + cell.count));
  }
}

// The particles do not fit into a single cell. Of two particles at the same position, the one with
// the lower id must be drawn first.
TEST(Arrangement, CrowdsThatCannotBeDividedStayInOrder) {
  scene::ParticleSet set = scene::generate_particles("uniform", 2600, scene::ColourKind::rgba8);
  for (auto& sphere : set.spheres) {
    for (std::size_t axis = 0; axis < 3; ++axis) sphere[axis] *= 1e-3F;
  }
  const std::size_t half = set.count();
  for (std::size_t i = 0; i < half; ++i) {
    set.spheres.push_back(set.spheres[i]);
    set.rgba8.push_back(set.rgba8[i]);
    set.ids.push_back(static_cast<std::uint32_t>(half + i));
  }
  // Because of this distant particle, the grid is so coarse that all other particles fall into the
  // same part of it.
  set.spheres.push_back({50, 50, 50, 1});
  set.rgba8.push_back(set.rgba8.front());
  set.ids.push_back(static_cast<std::uint32_t>(2 * half));
  scene::ParticleScene scene = scene_of(std::move(set));
  for (int view = 0; view < 8; ++view) {
    scene.camera = scene::particle_camera(fmt::format("random:{}", view), *scene.particles, 20);
    const Arrangement arranged = arrange(scene);
    ASSERT_GT(arranged.cells.size(), 2U);
    std::vector<std::uint32_t> ids = ids_of(arranged);
    std::erase(ids, static_cast<std::uint32_t>(2 * half));
    EXPECT_TRUE(std::ranges::is_sorted(ids)) << view;
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
  for (const Property property : {Property::sphere, Property::colour, Property::id}) {
    EXPECT_EQ(gathered(after, property), gathered(before, property));
  }
}

// A sphere that would make the box of its cell too large for culling gets a cell of its own.
TEST(Arrangement, ALargeSphereGetsItsOwnCell) {
  scene::ParticleSet set = scene::generate_particles("uniform", 20000, scene::ColourKind::rgba8);
  set.spheres[777][3] = 20;
  const Arrangement arranged = arrange(scene_of(std::move(set)));
  EXPECT_EQ(arranged.cells.front().count, 1U);
  EXPECT_EQ(arranged.id(0), 777U);
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
  EXPECT_TRUE(std::ranges::is_sorted(ids_of(arranged)));
  for (const Cell& cell : arranged.cells) EXPECT_LE(cell.count, 4 * particles_per_cell);
}

TEST(Arrangement, RadiiAreScaledAsTheSceneSays) {
  scene::ParticleScene scene = generated("uniform", 100);
  scene.radius_scale = 1.5;
  const Arrangement arranged = arrange(scene);
  for (std::size_t k = 0; k < arranged.count(); ++k) {
    EXPECT_EQ(arranged.sphere(k)[3], scene.radius(arranged.id(k)));
  }
}

TEST(Arrangement, OfNoParticlesIsEmpty) {
  EXPECT_EQ(arrange(scene_of({})).count(), 0U);
  EXPECT_TRUE(arrange(scene_of({})).cells.empty());
}

}  // namespace
}  // namespace triptych::technique
