// Tests voxels stored as half floats: images are within the error bound for the rounded data, they
// are unchanged if nothing is rounded, and half floats need half the memory of floats.

#include <algorithm>
#include <cmath>

#include "scene/half.hpp"
#include "under_test.hpp"
#include "volume_truth.hpp"

namespace triptych::contract {
namespace {

using measure::VolumeWork;
using scene::VoxelFormat;
using technique::Sampler;

constexpr std::array<int, 3> volume_size{40, 36, 44};

measure::Work work_of(const char* data, VoxelFormat format, Sampler sampler) {
  scene::VolumeScene scene = small_scene("surfaces");
  scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::generate_volume(data, volume_size), format));
  scene.camera = scene::camera_at("orbit_y:1/8", scene.box(), 90);
  return {.technique = "raycast",
          .scene =
              VolumeWork{.scene = std::move(scene),
                         .options = {.sampler = sampler, .skip = technique::Skip::none, .ert = 0}}};
}

// Tests float and 16-bit integer volumes with both techniques and every sampler.
TEST(Halves, StayWithinTheBoundOfTheRoundedData) {
  on_every_driver([](measure::Device& device) {
    double without_term = 0;
    for (const char* data : {"marschner_lobb", "nested_shells"}) {
      for (const Sampler sampler : {Sampler::hardware, Sampler::manual, Sampler::packed}) {
        for (const char* technique : {"raycast", "raycast_fragment"}) {
          for (const bool shading : {false, true}) {
            SCOPED_TRACE(std::string(data) + " " + std::string(technique::name_of(sampler)));
            measure::Work work = work_of(data, VoxelFormat::f16, sampler);
            work.technique = technique;
            std::get<VolumeWork>(work.scene).scene.shading.enabled = shading;
            if (device.unsupported(work)) continue;
            scene::Volume exact = scene::generate_volume(data, volume_size);
            ASSERT_FALSE(scene::fits_halves(exact));
            scene::VolumeScene scene = std::get<VolumeWork>(work.scene).scene;
            const VoxelFormat native = scene::lossless_format(exact);
            scene.grid =
                std::make_shared<const scene::VoxelGrid>(scene::encode(std::move(exact), native));
            volume_suite::PathPrecision path{
                .filter_weight_error = device.filter_weight_error({VoxelFormat::f16, sampler}),
                .storage_step = 0x1.0p-28,
                .voxel_rounding = scene::half_roundoff};
            const core::Image image = draw(device, work);
            const auto share = [&] {
              return share_of_bound(
                  image, reference::render_volume(scene, volume_suite::error_model(scene, path)));
            };
            EXPECT_LE(share(), 1);
            path.voxel_rounding = 0;
            without_term = std::max(without_term, share());
          }
        }
      }
    }
    EXPECT_GT(without_term, 1);  // images exceed a bound that ignores the rounding of voxels
  });
}

// An 8-bit volume stored as half floats stays within the bound of 8-bit voxels, because half floats
// represent 8-bit values exactly. With the sampler `packed` and in OpenCL's buffers, both formats
// reach the kernel as the same integers, so the counts are equal. In OpenCL, whose compilers do not
// reorder arithmetic, the images are also bit-identical.
TEST(Halves, OfBytesGiveTheSameImageAndCounts) {
  on_every_driver([](measure::Device& device) {
    const bool opencl = device.info().api == "opencl";
    for (const Sampler sampler : {Sampler::manual, Sampler::packed}) {
      for (const bool shading : {false, true}) {
        measure::Work bytes = work_of("mandelbulb", VoxelFormat::u8, sampler);
        measure::Work halves = work_of("mandelbulb", VoxelFormat::f16, sampler);
        for (measure::Work* each : {&bytes, &halves}) {
          auto& volume = std::get<VolumeWork>(each->scene);
          volume.scene.shading.enabled = shading;
          volume.options.skip = technique::Skip::distance;
        }
        if (device.unsupported(bytes)) continue;
        ASSERT_EQ(device.unsupported(halves), std::nullopt);
        expect_within_bound(device, halves);
        if (opencl) {
          EXPECT_EQ(draw(device, bytes), draw(device, halves));
        }
        if (opencl || sampler == Sampler::packed) {
          const auto counts = [&](const measure::Work& work) {
            return device.prepare(work)->frame(measure::Purpose::counters).counts;
          };
          EXPECT_EQ(counts(bytes), counts(halves));
        }
      }
    }
  });
}

TEST(Halves, NeedHalfTheMemoryOfFloats) {
  on_every_driver([](measure::Device& device) {
    const auto bytes_used = [&](VoxelFormat format) {
      const auto prepared = device.prepare(work_of("marschner_lobb", format, Sampler::manual));
      std::uint64_t total = 0;
      for (const auto& [name, bytes] : device.memory()) total += bytes;
      return total;
    };
    const auto voxels = [](int border) {
      return static_cast<std::uint64_t>(volume_size[0] + border) *
             static_cast<std::uint64_t>(volume_size[1] + border) *
             static_cast<std::uint64_t>(volume_size[2] + border);
    };
    const std::uint64_t saved = bytes_used(VoxelFormat::f32) - bytes_used(VoxelFormat::f16);
    const std::uint64_t expected = 2 * voxels(device.info().api == "opencl" ? 2 : 0);
    if (device.info().api == "vulkan") {  // memory use includes the padding of the image's rows
      EXPECT_NEAR(static_cast<double>(saved), static_cast<double>(expected),
                  0.25 * static_cast<double>(expected));
    } else {
      EXPECT_EQ(saved, expected);
    }
  });
}

}  // namespace
}  // namespace triptych::contract
