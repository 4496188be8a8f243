// Tests that drawing a volume in parts (slabs that fit into device memory one at a time) gives a
// bit-identical image and the same counts as drawing the whole volume.

#include "technique/volume/parts.hpp"

#include <fmt/format.h>

#include "technique/volume/packed_cells.hpp"
#include "under_test.hpp"
#include "volume_truth.hpp"

namespace triptych::contract {
namespace {

using scene::Quadrature;
using technique::Sampler;
using technique::Skip;

// Returns five cameras: outside of the volume; inside it, looking along the slabs; outside, looking
// across all slabs; inside, looking out through the last slab; and so far away that rays begin on a
// plane in front of the volume.
std::vector<scene::Camera> cameras(const scene::Box& box) {
  const glm::dvec3 size = box.hi - box.lo;
  const auto at = [&](double x, double y, double z) { return glm::dvec3(x, y, z) * size; };
  return {scene::camera_at("orbit_y:1/8", box, 90),
          scene::camera_looking_at({0.2 * size.x, 0.5 * size.y, 27.5}, at(0.9, 0.5, 0.45), 90),
          scene::camera_looking_at(at(0.4, 0.6, -0.5), at(0.45, 0.5, 0.5), 60),
          scene::camera_looking_at(at(0.6, 0.4, 0.9), at(0.5, 0.5, 3), 100),
          scene::camera_looking_at(at(900, 700, 20), at(0.5, 0.5, 0.5), 0.1)};
}

measure::VolumeWork& volume_of(measure::Work& work) {
  return std::get<measure::VolumeWork>(work.scene);
}

// Returns the number of bytes of the whole volume in the layout that its sampler reads. If the
// layout depends on the API, it is the largest one, which has a border of one voxel on every side.
double whole_bytes(const measure::VolumeWork& work) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  if (work.options.sampler == Sampler::packed) {
    return static_cast<double>(technique::packed_bytes(grid.size, grid.format));
  }
  double bytes = static_cast<double>(scene::bytes_of(grid.format));
  for (const int n : grid.size) bytes *= n + 2;
  return bytes;
}

struct Drawn {
  core::Image image;
  record::Counts counts;
  bool in_parts = false;
};

Drawn drawn(measure::Device& device, const measure::Work& work) {
  const auto prepared = device.prepare(work);
  Drawn result;
  result.in_parts = device.memory().contains("moved");
  result.counts = prepared->frame(measure::Purpose::counters).counts;
  const core::Image counted = prepared->image();
  static_cast<void>(prepared->frame(measure::Purpose::timing));
  result.image = prepared->image();
  EXPECT_EQ(counted, result.image);
  return result;
}

// For each n in `shares`, draws the volume with about 1/n of its voxels on the device, and compares
// the result with the whole volume.
void expect_same_as_whole(measure::Device& device, measure::Work work, std::vector<int> shares) {
  volume_of(work).options.budget = 0;
  const Drawn whole = drawn(device, work);
  EXPECT_FALSE(whole.in_parts);
  for (const int share : shares) {
    volume_of(work).options.budget =
        static_cast<std::uint64_t>(whole_bytes(volume_of(work)) / share);
    const Drawn parts = drawn(device, work);
    EXPECT_TRUE(parts.in_parts);
    EXPECT_EQ(parts.image, whole.image) << "1/" << share << " of the voxels";
    EXPECT_EQ(parts.counts, whole.counts) << "1/" << share << " of the voxels";
  }
}

// Returns the samplers with which the device can draw volumes in parts.
std::vector<Sampler> samplers(measure::Device& device, measure::Work work) {
  std::vector<Sampler> supported;
  for (const Sampler sampler : {Sampler::manual, Sampler::packed}) {
    volume_of(work).options.sampler = sampler;
    volume_of(work).options.budget = static_cast<std::uint64_t>(whole_bytes(volume_of(work)) / 2);
    if (!device.unsupported(work)) supported.push_back(sampler);
  }
  return supported;
}

measure::Work work_of(std::string_view generator, scene::VolumeScene scene) {
  scene::Volume volume = scene::generate_volume(generator, {37, 41, 61});
  const scene::VoxelFormat format = scene::lossless_format(volume);
  scene.grid = std::make_shared<const scene::VoxelGrid>(scene::encode(std::move(volume), format));
  scene.camera = cameras(scene.box()).front();
  return {.technique = "raycast",
          .scene = measure::VolumeWork{.scene = std::move(scene), .options = {}}};
}

// With `all`, draws from all cameras with skip=distance, and from the camera inside the volume that
// looks along the slabs with every other skip mode. Without `all`, draws only from that camera and
// only with skip=distance.
void expect_same_as_whole_for_skips(measure::Device& device, measure::Work& work, bool all) {
  const auto views = cameras(volume_of(work).scene.box());
  for (const Skip skip : {Skip::none, Skip::bricks, Skip::distance}) {
    for (std::size_t i = 0; i < views.size(); ++i) {
      if ((skip != Skip::distance || !all) && i != 1) continue;
      if (skip != Skip::distance && !all) continue;
      SCOPED_TRACE(fmt::format("skip {} camera {}", technique::name_of(skip), i));
      volume_of(work).scene.camera = views[i];
      volume_of(work).options.skip = skip;
      expect_same_as_whole(device, work, {5});
    }
  }
}

// Building the pipelines takes most of the time. Therefore, the midpoint rule and the cell rule are
// drawn without shading, and preintegration with shading. One sampler draws all skip modes and
// views, and the other samplers draw one view. With is_exhaustive_run(), each sampler draws all
// combinations.
TEST(Parts, MatchTheWholeVolumeInImageAndCounts) {
  on_every_driver([](measure::Device& device) {
    for (const Quadrature quadrature :
         {Quadrature::midpoint, Quadrature::preintegrated, Quadrature::cells}) {
      for (const bool shaded : {false, true}) {
        if (shaded != (quadrature == Quadrature::preintegrated) && !is_exhaustive_run()) continue;
        scene::VolumeScene scene = small_scene("surfaces");
        scene.quadrature = quadrature;
        scene.shading.enabled = shaded;
        measure::Work work = work_of("nested_shells", std::move(scene));
        const auto supported = samplers(device, work);
        ASSERT_FALSE(supported.empty());
        for (const Sampler sampler : supported) {
          SCOPED_TRACE(fmt::format("{} shaded {} {}", scene::name_of(quadrature), shaded,
                                   technique::name_of(sampler)));
          volume_of(work).options.sampler = sampler;
          const bool packed = shaded || quadrature == Quadrature::cells;
          const bool chosen = sampler == (packed ? supported.back() : supported.front());
          expect_same_as_whole_for_skips(device, work, chosen || is_exhaustive_run());
        }
      }
    }
  });
}

// Tests a volume of bytes and a volume of floats, rays that end early or never, and steps that are
// shorter or longer than a cell.
TEST(Parts, MatchTheWholeVolumeForEveryFormatAndStep) {
  on_every_driver([](measure::Device& device) {
    for (const std::string_view generator : {"sparse_field", "frequency_box"}) {
      for (const Quadrature quadrature : {Quadrature::midpoint, Quadrature::preintegrated}) {
        scene::VolumeScene scene = small_scene("haze");
        scene.quadrature = quadrature;
        measure::Work work = work_of(generator, std::move(scene));
        for (const Sampler sampler : samplers(device, work)) {
          volume_of(work).options.sampler = sampler;
          for (const double ert : {0.0, 0.25}) {
            for (const double step : {1.0 / 3, 4.0}) {
              SCOPED_TRACE(fmt::format("{} {} {} ert {} step {}", generator,
                                       scene::name_of(quadrature), technique::name_of(sampler), ert,
                                       step));
              volume_of(work).options.ert = ert;
              volume_of(work).scene.step_voxels = step;
              expect_same_as_whole(device, work, {2});
            }
          }
        }
      }
    }
  });
}

TEST(Parts, MatchWithMergedBricksOrDoublePrecision) {
  on_every_driver([](measure::Device& device) {
    measure::Work work = work_of("nested_shells", small_scene("haze"));
    const measure::Work plain = work;
    for (const Sampler sampler : samplers(device, work)) {
      work = plain;
      volume_of(work).options.sampler = sampler;
      volume_of(work).options.skip = Skip::bricks;
      volume_of(work).options.adapt = 0.01;
      expect_same_as_whole(device, work, {4});
      work = plain;
      volume_of(work).options.sampler = sampler;
      volume_of(work).options.precision = technique::Precision::fp64;
      if (!device.unsupported(work)) expect_same_as_whole(device, work, {4});
    }
  });
}

// A ray that walks from brick to brick (skip=bricks) may take one last sample beyond the point
// where it leaves a visible brick. The voxels of this sample may belong to a part in which all
// bricks are invisible, so that part must be uploaded, too.
TEST(Parts, InvisiblePartsAreReadIfAWalkReadsThem) {
  on_every_driver([](measure::Device& device) {
    scene::Volume volume{.size = {16, 16, 64}, .type = scene::ScalarType::u8, .range_hi = 255};
    for (int i = 0; i < 16 * 16 * 64; ++i) {
      volume.voxels.push_back(std::byte(i / 256 > 2 && i / 256 < 14 ? 200 : 0));
    }
    measure::Work work = default_work(device, std::move(volume), small_scene("surfaces"));
    for (const Sampler sampler : samplers(device, work)) {
      for (const Skip skip : {Skip::bricks, Skip::distance}) {
        for (int view = 0; view < 16; ++view) {
          SCOPED_TRACE(fmt::format("{} {} view {}", technique::name_of(sampler),
                                   technique::name_of(skip), view));
          auto& [scene, options] = volume_of(work);
          options.sampler = sampler;
          options.skip = skip;
          scene.camera = scene::camera_at(fmt::format("orbit_y:{}/16", view), scene.box(), 90);
          expect_same_as_whole(device, work, {2, 4});
        }
      }
    }
  });
}

TEST(Parts, StayWithinTheBound) {
  on_every_driver([](measure::Device& device) {
    measure::Work work = work_of("mandelbulb", small_scene("surfaces"));
    for (const Sampler sampler : samplers(device, work)) {
      volume_of(work).options.sampler = sampler;
      volume_of(work).options.budget = static_cast<std::uint64_t>(whole_bytes(volume_of(work)) / 3);
      expect_within_bound(device, work);
    }
  });
}

// No memory budget is set here. Devices draw this volume in parts if it is deeper than the images
// that they support.
TEST(Parts, VolumesDeeperThanAnyImageStayWithinTheBound) {
  on_every_driver([](measure::Device& device) {
    scene::Volume volume{.size = {5, 4, 5000}, .type = scene::ScalarType::u8, .range_hi = 100};
    for (int i = 0; i < 5 * 4 * 5000; ++i) volume.voxels.push_back(std::byte(i * 37 % 101));
    measure::Work work = default_work(device, std::move(volume), small_scene("haze"));
    auto& [scene, options] = volume_of(work);
    options.sampler = Sampler::manual;
    scene.camera = scene::camera_looking_at({2, 1.5, 2600}, {2.5, 2, 2500}, 60);
    const auto prepared = device.prepare(work);
    for (const char* name : {"maxImageDimension3D", "GL_MAX_3D_TEXTURE_SIZE"}) {
      const auto limit = device.info().limits.find(name);
      if (limit == device.info().limits.end()) continue;
      EXPECT_EQ(device.memory().contains("moved"), std::stoi(limit->second) < 5000) << name;
    }
    expect_within_bound(device, work);
  });
}

// If the budget is too small for the thinnest part, the reason names the budget. Techniques and
// samplers that cannot draw parts are rejected as well.
TEST(Parts, ImpossiblePartsAreRejectedWithAReason) {
  on_every_driver([](measure::Device& device) {
    measure::Work work = work_of("mandelbulb", small_scene("surfaces"));
    auto& options = volume_of(work).options;
    options.sampler = samplers(device, work).front();
    options.budget = 1000;
    const std::string thin = device.unsupported(work).value_or("");
    EXPECT_NE(thin.find("the budget is 1000; even its thinnest part needs"), std::string::npos)
        << thin;
    for (const std::string_view technique : {"raycast_fragment", "speed_of_light"}) {
      work.technique = technique;
      options.budget = 20'000;
      EXPECT_TRUE(device.unsupported(work)) << technique;
    }
    work.technique = "raycast";
    options.sampler = Sampler::hardware;
    EXPECT_TRUE(device.unsupported(work));
  });
}

}  // namespace
}  // namespace triptych::contract
