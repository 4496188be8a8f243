#include "scene/volume_scene.hpp"

#include <gtest/gtest.h>

#include "scene/generators.hpp"

namespace triptych::scene {
namespace {

TEST(VolumeScene, BoxAndStepFollowTheSpacing) {
  Volume volume = generate_volume("uniform_box", {4, 5, 6});
  volume.spacing = {2, 0.5, 1};
  VolumeScene scene;
  scene.grid = std::make_shared<VoxelGrid>(encode(std::move(volume), VoxelFormat::f32));
  scene.step_voxels = 0.25;
  EXPECT_EQ(scene.box().lo, glm::dvec3(0, 0, 0));
  EXPECT_EQ(scene.box().hi, glm::dvec3(8, 2.5, 6));
  EXPECT_EQ(scene.smallest_spacing(), 0.5);
  EXPECT_EQ(scene.step_world(), 0.125);
}

}  // namespace
}  // namespace triptych::scene
