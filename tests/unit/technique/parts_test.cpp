#include "technique/volume/parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scene/generators.hpp"
#include "technique/volume/brick_map.hpp"
#include "technique/volume/packed_cells.hpp"

namespace triptych::technique {
namespace {

constexpr Layers one_byte_layers{.bytes = 1, .more = 1, .whole = 102};

// Returns a scene with a volume of 100 slices and the eye at slice `eye_z`.
scene::VolumeScene scene_of(double eye_z) {
  scene::VolumeScene scene;
  scene.grid = std::make_shared<const scene::VoxelGrid>(scene::VoxelGrid{
      .format = scene::VoxelFormat::u8, .size = {4, 4, 100}, .spacing = {1, 1, 2}});
  scene.camera.eye = {2, 2, 2 * eye_z};
  return scene;
}

std::vector<Part> cut(const scene::VolumeScene& scene, std::uint64_t limit) {
  const Cut cut = cut_into_parts("raycast", scene, {}, one_byte_layers, {limit, "the room"});
  EXPECT_FALSE(cut.reason) << *cut.reason;
  return cut.parts;
}

TEST(Parts, AreNotUsedIfTheVolumeFits) {
  EXPECT_TRUE(cut(scene_of(50), 102).empty());
  EXPECT_FALSE(cut(scene_of(50), 101).empty());
}

TEST(Parts, ContainEveryCellOnceWithItsSamples) {
  for (const double eye : {-30.0, 0.0, 3.0, 49.5, 50.0, 99.0, 200.0}) {
    for (const bool shaded : {false, true}) {
      for (const std::uint64_t limit : {11U, 30U, 80U}) {
        scene::VolumeScene scene = scene_of(eye);
        scene.shading.enabled = shaded;
        const std::vector<Part> parts = cut(scene, limit);
        std::vector<int> drawn(101);
        for (const Part& part : parts) {
          EXPECT_LE(one_byte_layers.bytes_of(part.stored_cells()), limit);
          const int reach = shaded ? 2 : 1;
          EXPECT_LE(part.first_stored, std::max(part.begin - reach, 0));
          EXPECT_GE(part.end_stored, std::min(part.end + reach, 101));
          for (int cell = part.begin; cell < part.end; ++cell)
            ++drawn[static_cast<std::size_t>(cell)];
        }
        // The first part also takes the samples of one more cell on either side. These two cells
        // are counted twice.
        const Part& first = parts.front();
        for (const int neighbour : {first.begin, first.end - 1}) {
          int& times = drawn[static_cast<std::size_t>(neighbour)];
          if (times == 2) --times;
        }
        EXPECT_EQ(std::ranges::count(drawn, 1), 101) << "eye " << eye << " room " << limit;
      }
    }
  }
}

// Every ray must meet the parts in the order in which they are drawn: the first part contains the
// eye, and each later part continues upwards or downwards from there.
TEST(Parts, BeginAtTheEyeAndGoOutwards) {
  for (const double eye : {-30.0, 0.0, 37.0, 50.0, 99.0, 200.0}) {
    const std::vector<Part> parts = cut(scene_of(eye), 20);
    const double cell = std::clamp(eye + 0.5, 0.0, 100.0);
    EXPECT_LE(parts.front().begin, cell);
    EXPECT_GE(parts.front().end, cell);
    int below = parts.front().begin;
    int above = parts.front().end;
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const bool down = parts[i].end == below + 1 || parts[i].end == below;
      const bool up = parts[i].begin == above - 1 || parts[i].begin == above;
      EXPECT_TRUE(down || up) << "part " << i << ", eye " << eye;
      if (down) below = parts[i].begin;
      if (up && !down) above = parts[i].end;
    }
    EXPECT_EQ(below, 0);
    EXPECT_EQ(above, 101);
  }
}

// A part must contain the voxels of whole steps, because a preintegrated step reads the values at
// both of its ends.
TEST(Parts, ContainWholeSteps) {
  scene::VolumeScene scene = scene_of(50);
  scene.quadrature = scene::Quadrature::preintegrated;
  scene.step_voxels = 6.5;
  for (const Part& part : cut(scene, 60)) {
    EXPECT_LE(part.first_stored, std::max(part.begin - 8, 0));
    EXPECT_GE(part.end_stored, std::min(part.end + 8, 101));
  }
}

TEST(Parts, AreRejectedWithAReason) {
  const scene::VolumeScene scene = scene_of(50);
  const auto reason = [&](std::string_view technique, Sampler sampler, std::uint64_t limit) {
    return cut_into_parts(technique, scene, {.sampler = sampler}, one_byte_layers,
                          within_budget({limit, "theLimit"}, {}))
        .reason.value_or("");
  };
  EXPECT_EQ(reason("raycast", Sampler::manual, 5),
            "the volume needs 102 bytes, but theLimit is 5; even its thinnest part needs 6 bytes");
  EXPECT_EQ(reason("raycast", Sampler::manual, 6), "");
  EXPECT_EQ(
      reason("raycast_fragment", Sampler::manual, 50),
      "the volume needs 102 bytes, but theLimit is 50; raycast_fragment cannot draw a volume in "
      "parts");
  EXPECT_NE(
      reason("raycast", Sampler::hardware, 50).find("requires sampler=manual or sampler=packed"),
      std::string::npos);
  EXPECT_EQ(within_budget({1000, "theLimit"}, {.budget = 10}).name, "the budget");
  EXPECT_EQ(within_budget({1000, "theLimit"}, {.budget = 2000}).bytes, 1000U);
}

TEST(Parts, AreReadIfABrickNearThemIsVisible) {
  scene::VolumeScene scene = scene_of(50);
  scene::VoxelGrid grid = *scene.grid;
  grid.data.resize(grid.voxel_count());
  grid.scale = 1.0 / 255;
  grid.data[16U * 70U] = std::byte{255};  // in slice 70
  scene.grid = std::make_shared<const scene::VoxelGrid>(std::move(grid));
  scene.transfer_function = scene::load_transfer_function("surfaces");
  const std::vector<Part> parts = cut(scene, 20);
  for (const Skip skip : {Skip::bricks, Skip::distance, Skip::none}) {
    const auto map = brick_map(scene, skip);
    int read = 0;
    for (const PartPass& pass : part_passes(parts, scene, {.skip = skip}, map)) {
      EXPECT_EQ(pass.parameters.first_stored, pass.part.first_stored);
      read += pass.read ? 1 : 0;
      const bool has_slice_70 = pass.part.begin <= 71 && pass.part.end > 70;
      EXPECT_TRUE(pass.read || !has_slice_70);
    }
    // Unless rays leap over empty bricks, a ray may take its last sample beyond the exit of a
    // brick, where another part may begin. All parts must then be read.
    if (skip == Skip::distance) {
      EXPECT_LE(read, 3);
    } else {
      EXPECT_EQ(read, static_cast<int>(parts.size())) << name_of(skip);
    }
  }
}

TEST(Layers, AreThoseOfTheCells) {
  for (const auto format : {scene::VoxelFormat::u8, scene::VoxelFormat::u16,
                            scene::VoxelFormat::f32, scene::VoxelFormat::f16}) {
    const std::array<int, 3> size{7, 5, 9};
    const Layers packed = packed_layers(size, format);
    EXPECT_EQ(packed.whole, packed_bytes(size, format));
    EXPECT_EQ(packed.bytes_of(10), packed.whole);
    EXPECT_EQ(slice_layers(size, format).whole, 7U * 5U * 9U * scene::bytes_of(format));
  }
}

TEST(Layers, AreThoseOfTheSampler) {
  scene::VolumeScene scene;
  scene.grid = std::make_shared<scene::VoxelGrid>(
      scene::VoxelGrid{.format = scene::VoxelFormat::u16, .size = {7, 5, 9}});
  const auto whole = [&](Sampler sampler) { return layers_of(scene, {.sampler = sampler}).whole; };
  EXPECT_EQ(whole(Sampler::packed), packed_bytes({7, 5, 9}, scene::VoxelFormat::u16));
  for (const Sampler sampler : {Sampler::manual, Sampler::hardware}) {
    EXPECT_EQ(whole(sampler), 2U * 7U * 5U * 9U);
  }
}

TEST(Slices, LieAroundTheCells) {
  scene::VoxelGrid grid{.format = scene::VoxelFormat::u8, .size = {1, 1, 9}};
  grid.data.resize(9);
  for (std::size_t i = 0; i < 9; ++i) grid.data[i] = std::byte{static_cast<unsigned char>(i)};
  const auto slices = [&](int first, int end) {
    const Slices of = slices_of({.first_stored = first, .end_stored = end}, grid);
    EXPECT_EQ(of.bytes.size(), static_cast<std::size_t>(of.count));
    return std::pair{static_cast<int>(of.bytes.front()), of.count};
  };
  EXPECT_EQ(slices(0, 3), std::pair(0, 3));   // cells 0 … 2 use slices 0 … 2
  EXPECT_EQ(slices(3, 5), std::pair(2, 3));   // cells 3 and 4 use slices 2 … 4
  EXPECT_EQ(slices(8, 10), std::pair(7, 2));  // the last cells use slices 7 and 8
}

}  // namespace
}  // namespace triptych::technique
