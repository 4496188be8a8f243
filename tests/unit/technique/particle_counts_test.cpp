#include "technique/particles/particle_counts.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace triptych::technique {
namespace {

using testing::Contains;
using testing::Not;
using testing::Pair;
using testing::UnorderedElementsAre;

core::Image image_of(std::vector<std::uint32_t> ids) {
  core::Image image(static_cast<int>(ids.size()), 1);
  image.ids = std::move(ids);
  return image;
}

// Returns sums in which the first row contains 10, 20, 30, …, and the last row contains only ones.
std::vector<std::uint32_t> two_rows() {
  std::vector<std::uint32_t> sums(particle_counter_rows * particle_counter_columns);
  for (std::uint32_t column = 0; column < particle_counter_columns; ++column) {
    sums[column] = 10 * (column + 1);
    sums[sums.size() - particle_counter_columns + column] = 1;
  }
  sums[static_cast<std::size_t>(ParticleCounter::discarded)] = 4;
  return sums;
}

TEST(ParticleCounts, OfSpritesAddUpAllRows) {
  const CountedFrame frame{.culling = Culling::frustum, .cells = 90, .particles = 100};
  EXPECT_THAT(particle_counts(frame, two_rows(), image_of({3, 3, core::Image::no_particle})),
              UnorderedElementsAre(Pair("cells", 90), Pair("cells_culled", 71),
                                   Pair("particles_submitted", 61), Pair("particles_culled", 39),
                                   Pair("sprites", 11), Pair("vertices", 21), Pair("fragments", 31),
                                   Pair("fragments_discarded", 5), Pair("fragments_kept", 26),
                                   Pair("visible_ids", 1)));
}

TEST(ParticleCounts, OfTilesContainBinEntriesAndNoFragments) {
  const CountedFrame frame{
      .method = Method::tiles, .culling = Culling::frustum, .cells = 90, .particles = 100};
  const auto counts = particle_counts(frame, two_rows(), image_of({1}));
  EXPECT_THAT(counts, Contains(Pair("bin_entries", 51)));
  EXPECT_THAT(counts, Not(Contains(Pair(testing::StartsWith("fragments"), testing::_))));
}

TEST(ParticleCounts, OfRaysContainNodesAndBoxes) {
  const CountedFrame frame{.method = Method::rays, .cells = 90, .particles = 100};
  EXPECT_THAT(particle_counts(frame, two_rows(), image_of({1})),
              UnorderedElementsAre(Pair("nodes_visited", 11), Pair("boxes_tested", 21),
                                   Pair("intersections_tested", 31), Pair("visible_ids", 1)));
}

TEST(ParticleCounts, WithoutCullingAllIsSubmitted) {
  const auto counts = particle_counts({.cells = 90, .particles = 100}, two_rows(), image_of({1}));
  EXPECT_THAT(counts, Contains(Pair("particles_submitted", 100)));
  EXPECT_THAT(counts, Contains(Pair("cells_culled", 0)));
}

TEST(VisibleIds, AreDifferentOnesWithoutTheBackground) {
  constexpr std::uint32_t none = core::Image::no_particle;
  EXPECT_EQ(visible_ids(image_of({none, 2, 7, 2, none, 0})), 3U);
  EXPECT_EQ(visible_ids(image_of({none, none})), 0U);
  EXPECT_EQ(visible_ids(image_of({5})), 1U);
}

}  // namespace
}  // namespace triptych::technique
