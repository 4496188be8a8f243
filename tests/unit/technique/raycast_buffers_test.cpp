#include "technique/volume/raycast_buffers.hpp"

#include <gtest/gtest.h>

#include <span>

#include "scene/generators.hpp"
#include "technique/largest_image.hpp"
#include "technique/volume/brick_map.hpp"
#include "technique/volume/extra_work.hpp"
#include "technique/volume/quadrature_table.hpp"

namespace triptych::technique {
namespace {

scene::VolumeScene scene_of(std::array<int, 3> size) {
  scene::VolumeScene scene;
  scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::generate_volume("gaussian_blob", size), scene::VoxelFormat::u8));
  scene.transfer_function = scene::load_transfer_function("surfaces");
  scene.width = 61;
  scene.height = 40;
  return scene;
}

TEST(RaycastBuffers, MatchTheAllocatedBuffers) {
  for (const std::array<int, 3> size : {std::array{1, 1, 1}, {2, 3, 4}, {24, 17, 9}}) {
    scene::VolumeScene scene = scene_of(size);
    for (const auto quadrature : {scene::Quadrature::midpoint, scene::Quadrature::preintegrated,
                                  scene::Quadrature::cells}) {
      scene.quadrature = quadrature;
      for (const Skip skip : {Skip::bricks, Skip::distance}) {
        const auto map = brick_map(scene, skip);
        EXPECT_EQ(raycast_buffers(scene, {.skip = skip}).bricks,
                  std::as_bytes(std::span(map)).size())
            << size[0] << ' ' << name_of(skip);
      }
    }
    const RaycastBuffers buffers = raycast_buffers(scene, {.extra_work_stride = 5});
    EXPECT_EQ(buffers.table, quadrature_table_bytes(scene.quadrature));
    EXPECT_EQ(buffers.counters, 61U * 40U * 32U);
    EXPECT_EQ(buffers.image, 16U * static_cast<std::uint64_t>(drawn_pixels(61, 40, 5)));
    EXPECT_EQ(buffers.all(), buffers.table + buffers.counters + buffers.image + buffers.bricks);
  }
}

// The volume has 1024³ voxels. Its map of bricks with 4³ cells needs 64 MiB; with 2³ cells, the map
// would need 512 MiB.
TEST(RaycastBuffers, ATooLargeBufferIsReported) {
  constexpr std::uint64_t most = 1U << 27U;
  scene::VolumeScene scene = scene_of({2, 2, 2});
  auto grid = *scene.grid;
  grid.size = {1024, 1024, 1024};
  scene.grid = std::make_shared<const scene::VoxelGrid>(grid);
  const auto reason = [&](Skip skip, std::uint64_t part = 1) {
    return buffer_reason(raycast_buffers(scene, {.skip = skip}), most / part, "theLimit")
        .value_or("");
  };
  EXPECT_EQ(reason(Skip::distance), "");
  EXPECT_EQ(reason(Skip::distance, 4),
            "the raycaster needs 67108864 bytes for its brick map, but theLimit is 33554432");
  EXPECT_EQ(reason(Skip::bricks), "");
  scene.width = 2048;
  scene.height = 2048;
  EXPECT_EQ(reason(Skip::bricks), "");
  scene.width = 2049;
  EXPECT_EQ(reason(Skip::bricks),
            "the raycaster needs 134283264 bytes for its counters, but theLimit is 134217728; the "
            "largest square image is 2048x2048");
}

TEST(LargestSquare, IsExact) {
  for (const std::uint64_t edge : {1ULL, 2ULL, 2896ULL, 94906267ULL, 4294967295ULL}) {
    EXPECT_EQ(largest_square(edge * edge - 1), edge - 1);
    EXPECT_EQ(largest_square(edge * edge), edge);
    EXPECT_EQ(largest_square(edge * edge + edge), edge);
  }
  EXPECT_EQ(largest_square(0), 0U);
}

}  // namespace
}  // namespace triptych::technique
