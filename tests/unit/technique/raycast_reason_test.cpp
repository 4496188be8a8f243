// Tests the parameters of the raycaster, and the reasons for which a scene is rejected before
// anything is drawn.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/generators.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::technique {
namespace {

using testing::HasSubstr;

// Returns a cube of 8³ voxels with an edge length of 1, except that voxels have the thickness
// `flat` along z.
scene::VolumeScene flat_scene(double flat) {
  scene::Volume volume = scene::generate_volume("uniform_box", {8, 8, 8});
  volume.spacing = {0.125, 0.125, flat};
  return {.grid = std::make_shared<const scene::VoxelGrid>(
              scene::encode(std::move(volume), scene::VoxelFormat::f32))};
}

TEST(RaycastReason, SampleCountsMustFitIntoDeviceIntegers) {
  EXPECT_FALSE(raycast_reason("raycast", flat_scene(1e-8), {}));
  scene::VolumeScene scene = flat_scene(1e-10);
  EXPECT_THAT(raycast_reason("raycast", scene, {}).value_or(""),
              HasSubstr("1.4e+10 samples, but the limit is 2³⁰; use a longer step"));
  scene.step_voxels = 4096;
  EXPECT_FALSE(raycast_reason("raycast", scene, {}));
}

// With the quadrature `cells`, rays advance from one grid plane to the next, so the spacing does
// not matter.
TEST(RaycastReason, OfCellsHasNoSamplesToCount) {
  scene::VolumeScene scene = flat_scene(1e-10);
  scene.quadrature = scene::Quadrature::cells;
  EXPECT_FALSE(raycast_reason("raycast", scene, {}));
}

TEST(RaycastParameters, OfCellsAreTheSameForAllStepsLongerThanACell) {
  scene::VolumeScene scene = flat_scene(0.5);
  scene.quadrature = scene::Quadrature::cells;
  const auto one = raycast_parameters(scene, {}, 1);
  scene.step_voxels = 7;
  EXPECT_EQ(raycast_parameters(scene, {}, 1), one);
  scene.quadrature = scene::Quadrature::midpoint;
  EXPECT_NE(raycast_parameters(scene, {}, 1), one);
}

}  // namespace
}  // namespace triptych::technique
