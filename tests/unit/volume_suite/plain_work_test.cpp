// Tests which configurations are recognized as doing the same work in a volume scene.

#include "suites/volume/plain_work.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "scene/generators.hpp"

namespace triptych::volume_suite {
namespace {

measure::VolumeWork work_of(const std::string& generator, technique::Skip skip) {
  measure::VolumeWork work;
  work.scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::generate_volume(generator, {24, 24, 24}), scene::VoxelFormat::f32));
  work.scene.transfer_function = scene::load_transfer_function("haze");
  work.options.skip = skip;
  work.options.ert = 0.25;
  return work;
}

measure::PlainWork plain(const std::string& generator, technique::Skip skip,
                         const std::string& technique = "raycast") {
  return plain_work(
      {{"technique", technique}, {"skip", std::string(technique::name_of(skip))}, {"ert", "0.25"}},
      work_of(generator, skip));
}

TEST(PlainVolumeWork, LeapsWithoutEmptyBricksAreEquivalentToNone) {
  const auto full = plain("uniform_box", technique::Skip::distance);
  EXPECT_EQ(full.levels.at("skip"), "none");
  EXPECT_TRUE(full.why.contains("skip"));
  EXPECT_EQ(full.levels, plain("uniform_box", technique::Skip::none).levels);
}

// To find out that a brick is not empty, a ray must visit it, and the visit is counted.
TEST(PlainVolumeWork, ForCellsLeapsWithoutEmptyBricksAreWork) {
  measure::VolumeWork work = work_of("uniform_box", technique::Skip::distance);
  work.scene.quadrature = scene::Quadrature::cells;
  const auto plain = plain_work({{"technique", "raycast"}, {"skip", "distance"}}, work);
  EXPECT_EQ(plain.levels.at("skip"), "distance");
}

TEST(PlainVolumeWork, AWalkThroughAFullVolumeIsWork) {
  EXPECT_EQ(plain("uniform_box", technique::Skip::bricks).levels.at("skip"), "bricks");
}

TEST(PlainVolumeWork, LeapsDifferIfThereAreEmptyBricks) {
  EXPECT_EQ(plain("sparse_field", technique::Skip::distance).levels.at("skip"), "distance");
}

TEST(PlainVolumeWork, SpeedOfLightHasNoEarlyTermination) {
  EXPECT_EQ(plain("uniform_box", technique::Skip::none).ends_below, 0.25);
  const auto bare = plain("uniform_box", technique::Skip::none, "speed_of_light");
  EXPECT_EQ(bare.ends_below, 0);
  EXPECT_FALSE(bare.levels.contains("ert"));
}

}  // namespace
}  // namespace triptych::volume_suite
