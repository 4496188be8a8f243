#include "scene/particle_generators.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "core/error.hpp"

namespace triptych::scene {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;
using testing::ThrowsMessage;

// Returns the box around the centres. (A bounding box of the spheres would include their radii.)
Box box_of_centres(const ParticleSet& set) {
  Box box{glm::dvec3(1e30), glm::dvec3(-1e30)};
  for (const auto& sphere : set.spheres) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = sphere.at(static_cast<std::size_t>(axis));
      box.lo[axis] = std::min(box.lo[axis], x);
      box.hi[axis] = std::max(box.hi[axis], x);
    }
  }
  return box;
}

TEST(ParticleGenerators, AreBitIdenticalEverywhere) {
  // If one of these hashes changes, every baseline that uses the data set is invalid.
  const std::map<std::string, std::string> hashes{
      {"uniform", "61b18ae12f76b005ebf1940b716909a1"},
      {"droplets", "73c7764209bc54a9b7fdd96e99f61ecc"},
      {"layer", "7fbd87d4c99dae6a2ec8e37a77d61365"},
      {"plume", "363c213429ad431a41d2b6a102779bae"},
      {"coincident", "4dd5507c44927a3f5382751f9dbd03bb"},
      {"wall", "180f7ec17b948ebb2c7aaecdc698807c"},
      {"hidden", "3b213a64fe9d34d7a92c5929c7b156bd"}};
  for (const GeneratorInfo& info : particle_generators()) {
    const std::string name(info.name);
    EXPECT_EQ(generate_particles(name, 1000, ColourKind::rgba8).hash, hashes.at(name)) << name;
  }
}

TEST(ParticleGenerators, CreateTheRequestedCountInEveryKindOfColour) {
  for (const GeneratorInfo& info : particle_generators()) {
    for (const std::uint64_t count : {1U, 2U, 7U, 1001U}) {
      SCOPED_TRACE(std::string(info.name) + ":" + std::to_string(count));
      const ParticleSet bytes = generate_particles(info.name, count, ColourKind::rgba8);
      EXPECT_EQ(bytes.count(), count);
      EXPECT_EQ(bytes.dropped, 0U);
      EXPECT_EQ(bytes.name, "generate:" + std::string(info.name) + ":" + std::to_string(count));
      ASSERT_EQ(bytes.ids.size(), count);
      for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(bytes.ids[i], i);
      EXPECT_EQ(bytes.rgba8.size(), count);
      EXPECT_TRUE(bytes.rgba32.empty());
      EXPECT_TRUE(bytes.intensity.empty());
      const ParticleSet floats = generate_particles(info.name, count, ColourKind::rgba32);
      EXPECT_EQ(floats.rgba32.size(), count);
      EXPECT_TRUE(floats.rgba8.empty());
      EXPECT_EQ(floats.spheres, bytes.spheres) << "places depend on the kind of colour";
      EXPECT_NE(floats.hash, bytes.hash);
      const ParticleSet scalars = generate_particles(info.name, count, ColourKind::intensity);
      EXPECT_EQ(scalars.intensity.size(), count);
      EXPECT_THAT(scalars.intensity, Each(AllOf(Ge(0.0F), Le(1.0F))));
    }
  }
}

TEST(ParticleGenerators, BytesAreTheNearestToTheFloats) {
  const ParticleSet bytes = generate_particles("uniform", 100, ColourKind::rgba8);
  const ParticleSet floats = generate_particles("uniform", 100, ColourKind::rgba32);
  for (std::size_t i = 0; i < 100; ++i) {
    for (unsigned channel = 0; channel < 4; ++channel) {
      const auto byte = static_cast<float>((bytes.rgba8[i] >> (8 * channel)) & 0xFFU);
      EXPECT_NEAR(byte / 255, floats.rgba32[i].at(channel), 0.5F / 255 + 1e-6F);
    }
  }
}

TEST(ParticleGenerators, UniformFillsATenthOfItsBoxEvenly) {
  const ParticleSet set = generate_particles("uniform", 80'000, ColourKind::intensity);
  double volume = 0;
  std::array<int, 8> octants{};
  for (const auto& [x, y, z, r] : set.spheres) {
    volume += 4 * std::numbers::pi / 3 * std::pow(static_cast<double>(r), 3);
    ++octants.at((x < 5 ? 0U : 1U) + (y < 5 ? 0U : 2U) + (z < 5 ? 0U : 4U));
  }
  EXPECT_NEAR(volume, 100, 1e-3);
  // The tolerance is five standard deviations of a binomial distribution.
  for (const int count : octants) EXPECT_NEAR(count, 10'000, 5 * std::sqrt(80'000 * 7 / 64.0));
  const Box box = box_of_centres(set);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.lo[axis], 0, 0.01);
    EXPECT_NEAR(box.hi[axis], 10, 0.01);
    EXPECT_GE(box.lo[axis], 0);
    EXPECT_LE(box.hi[axis], 10);
  }
}

TEST(ParticleGenerators, DropletsAreDenseInAMostlyEmptyBox) {
  const ParticleSet set = generate_particles("droplets", 40'000, ColourKind::rgba8);
  // Collects the cells that contain droplets. A cell is a cube with an edge of half a unit.
  std::set<std::array<int, 3>> cells;
  for (const auto& sphere : set.spheres) {
    cells.insert({static_cast<int>(sphere[0] * 2), static_cast<int>(sphere[1] * 2),
                  static_cast<int>(sphere[2] * 2)});
  }
  // The box has 16,000 cells. The droplets fill about 160 units of volume, which are 1,280 cells,
  // and each of the 2,000 vapour particles occupies at most one more cell.
  EXPECT_LT(cells.size(), 16'000 / 4);
  EXPECT_LE(box_of_centres(set).hi.x, 20);
}

TEST(ParticleGenerators, LayerLiesAcrossTheMiddle) {
  const ParticleSet set = generate_particles("layer", 20'000, ColourKind::rgba8);
  const auto in_middle = std::ranges::count_if(
      set.spheres, [](const auto& sphere) { return std::abs(sphere[2] - 20) < 4.5F; });
  EXPECT_GT(in_middle, 18'500);
  const auto above = std::ranges::count_if(set.spheres, [](const auto& s) { return s[2] > 24.5F; });
  const auto below = std::ranges::count_if(set.spheres, [](const auto& s) { return s[2] < 15.5F; });
  EXPECT_GT(above, 300);
  EXPECT_GT(below, 300);
}

TEST(ParticleGenerators, PlumeThinsOutWithHeightAboveALatticeWithACrater) {
  const ParticleSet set = generate_particles("plume", 50'000, ColourKind::rgba8);
  std::array<int, 3> heights{};
  std::size_t in_slab = 0;
  float smallest = 1e30F;
  float largest = 0;
  for (std::size_t i = 0; i < set.count(); ++i) {
    const auto& [x, y, z, r] = set.spheres[i];
    smallest = std::min(smallest, r);
    largest = std::max(largest, r);
    if (y >= 2 && y < 20) ++heights.at(static_cast<std::size_t>((y - 2) / 6));
    // The particles of the lattice come first in the set, layer by layer from top to bottom. They
    // leave the crater empty.
    if (in_slab == i && y < 0 && (i == 0 || y <= set.spheres[i - 1][1])) {
      ++in_slab;
      EXPECT_GE(x * x + y * y + z * z, 15.99F);
    }
  }
  EXPECT_GT(in_slab, 25'000U);
  EXPECT_LT(in_slab, 40'000U);
  EXPECT_GT(heights[0], heights[1]);
  EXPECT_GT(heights[1], heights[2]);
  EXPECT_GT(heights[2], 0);
  EXPECT_GT(largest, 1.8F * smallest);
  EXPECT_LE(largest, 2 * smallest);
}

TEST(ParticleGenerators, CoincidentRepeatsEveryPositionEightTimes) {
  const ParticleSet set = generate_particles("coincident", 800, ColourKind::rgba8);
  std::map<std::array<float, 4>, std::set<std::uint32_t>> places;
  for (std::size_t i = 0; i < set.count(); ++i) places[set.spheres[i]].insert(set.rgba8[i]);
  EXPECT_EQ(places.size(), 100U);
  for (const auto& [place, colours] : places) EXPECT_GE(colours.size(), 7U);
}

TEST(ParticleGenerators, ReportProgressInHundredths) {
  for (const GeneratorInfo& info : particle_generators()) {
    double last = 0;
    int calls = 0;
    const ParticleSet set =
        generate_particles(info.name, 10'000, ColourKind::rgba8, [&](double share) {
          EXPECT_GE(share, last);
          EXPECT_LE(share, last + 0.0101);
          last = share;
          ++calls;
        });
    EXPECT_EQ(last, 1) << info.name;
    EXPECT_LE(calls, 102);
  }
}

TEST(ParticleGenerators, RejectUnknownNames) {
  EXPECT_THAT([] { static_cast<void>(generate_particles("unifrom", 10, ColourKind::rgba8)); },
              ThrowsMessage<core::InputError>(
                  AllOf(HasSubstr("'unifrom'"), HasSubstr("uniform, droplets, layer"))));
  EXPECT_THAT([] { static_cast<void>(generate_particles("uniform", 0, ColourKind::rgba8)); },
              ThrowsMessage<core::InputError>(HasSubstr("expected a count from 1 to 20000000")));
  EXPECT_THROW(static_cast<void>(generate_particles("uniform", 20'000'001, ColourKind::rgba8)),
               core::InputError);
}

TEST(ParticleHash, DependsOnEveryArray) {
  ParticleSet set = generate_particles("uniform", 3, ColourKind::rgba8);
  const std::string hash = particle_hash(set);
  EXPECT_EQ(hash, set.hash);
  const auto changed = [&](auto&& change) {
    ParticleSet other = set;
    change(other);
    return particle_hash(other) != hash;
  };
  EXPECT_TRUE(changed([](ParticleSet& other) { other.spheres[2][3] *= 2; }));
  EXPECT_TRUE(changed([](ParticleSet& other) { std::swap(other.ids[0], other.ids[1]); }));
  EXPECT_TRUE(changed([](ParticleSet& other) { other.rgba8[0] ^= 1U; }));
  EXPECT_TRUE(changed([](ParticleSet& other) { other.intensity.push_back(0); }));
  EXPECT_TRUE(changed([](ParticleSet& other) { other.rgba32.push_back({}); }));
  EXPECT_TRUE(changed([](ParticleSet& other) { other.colour = ColourKind::rgba32; }));
  EXPECT_TRUE(changed([](ParticleSet& other) { other.dropped = 1; }));
  EXPECT_FALSE(changed([](ParticleSet& other) { other.name = "another"; }));
}

// Both data sets contain the same wall in the same box, so that the same camera shows the same
// image of it.
TEST(ParticleGenerators, HiddenSpheresAreBehindAnEqualWall) {
  const ParticleSet wall = generate_particles("wall", 2000, ColourKind::rgba8);
  const ParticleSet hidden = generate_particles("hidden", 20000, ColourKind::rgba8);
  constexpr std::size_t in_wall = 44 * 44;
  for (std::size_t i = 0; i < in_wall; ++i) ASSERT_EQ(wall.spheres[i], hidden.spheres[i]);
  const float plane = wall.spheres[0][2];
  for (std::size_t i = in_wall; i < hidden.count(); ++i) {
    const auto& [x, y, z, r] = hidden.spheres[i];
    ASSERT_LE(z + r, plane);
    ASSERT_GE(std::min(x, y) - r, 0);
    ASSERT_LE(std::max(x, y) + r, 10.0001);
  }
  const Box one = bounding_box(wall);
  const Box other = bounding_box(hidden);
  EXPECT_EQ(one.lo, other.lo);
  EXPECT_EQ(one.hi, other.hi);
  EXPECT_EQ(one.lo.z, 0);
}

}  // namespace
}  // namespace triptych::scene
