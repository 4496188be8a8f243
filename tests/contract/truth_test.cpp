// Tests that images differ from the reference image by no more than the derived error bound, on the
// device's default path (its preferred voxel format and sampler) and on every other path.

#include <cmath>

#include "data_folder.hpp"
#include "technique/volume/filter_bound.hpp"
#include "under_test.hpp"
#include "volume_truth.hpp"

namespace triptych::contract {
namespace {

using measure::VolumeWork;

TEST(Truth, EveryPathStaysWithinItsBound) {
  on_every_device([](measure::Device& device) {
    for (const scene::VoxelFormat format : {scene::VoxelFormat::u8, scene::VoxelFormat::u16,
                                            scene::VoxelFormat::f32, scene::VoxelFormat::f16}) {
      for (const technique::Sampler sampler :
           {technique::Sampler::hardware, technique::Sampler::manual, technique::Sampler::packed}) {
        SCOPED_TRACE(std::string(scene::name_of(format)) + " " +
                     std::string(technique::name_of(sampler)));
        scene::VolumeScene scene = small_scene("surfaces");
        scene.shading.enabled = true;
        measure::Work work = default_work(
            device, scene::generate_volume("mandelbulb", {40, 40, 40}), std::move(scene));
        VolumeWork& volume = std::get<VolumeWork>(work.scene);
        volume.scene.grid = std::make_shared<const scene::VoxelGrid>(
            scene::encode(scene::generate_volume("mandelbulb", {40, 40, 40}), format));
        volume.options.sampler = sampler;
        if (device.unsupported(work)) continue;
        expect_within_bound(device, work);
      }
    }
  });
}

// The last sample of a ray may lie several voxels behind the point where the ray leaves the volume.
// The field is constant there and has no gradient.
TEST(Truth, ShadedLongStepsStayWithinTheBound) {
  on_every_device([](measure::Device& device) {
    for (const technique::Sampler sampler :
         {technique::Sampler::hardware, technique::Sampler::manual, technique::Sampler::packed}) {
      for (const double step : {1.5, 2.0, 8.0}) {
        SCOPED_TRACE(std::string(technique::name_of(sampler)) + " " + std::to_string(step));
        scene::VolumeScene scene = small_scene("haze");
        scene.shading.enabled = true;
        scene.step_voxels = step;
        measure::Work work = default_work(
            device, scene::generate_volume("frequency_box", {32, 32, 32}), std::move(scene));
        std::get<VolumeWork>(work.scene).options.sampler = sampler;
        if (device.unsupported(work)) continue;
        expect_within_bound(device, work);
      }
    }
  });
}

// A device with a faulty sampler must fail, rather than get a bound that is wide enough to pass.
TEST(Truth, NoSamplerWidensItsBoundBeyondTheAllowedFilterError) {
  on_every_device([](measure::Device& device) {
    for (const scene::VoxelFormat format : {scene::VoxelFormat::u8, scene::VoxelFormat::u16,
                                            scene::VoxelFormat::f32, scene::VoxelFormat::f16}) {
      measure::Work work = default_work(device, scene::generate_volume("mandelbulb", {8, 8, 8}),
                                        small_scene("haze"));
      VolumeWork& volume = std::get<VolumeWork>(work.scene);
      volume.scene.grid = std::make_shared<const scene::VoxelGrid>(
          scene::encode(scene::generate_volume("mandelbulb", {8, 8, 8}), format));
      volume.options.sampler = technique::Sampler::hardware;
      if (device.unsupported(work)) continue;
      EXPECT_LE(device.filter_weight_error({format, technique::Sampler::hardware}),
                technique::allowed_filter_error(technique::least_weight_bits, format))
          << scene::name_of(format);
    }
  });
}

TEST(Truth, RealVolumesStayWithinTheBound) {
  const auto files = real_volumes();
  if (files.empty()) GTEST_SKIP() << "TRIPTYCH_DATA names no folder with volumes/";
  on_every_device([&](measure::Device& device) {
    for (const auto& file : files) {
      const scene::Volume volume = scene::load_volume(file.string());
      for (const std::string_view function : scene::transfer_function_presets()) {
        SCOPED_TRACE(file.filename().string() + " " + std::string(function));
        expect_within_bound(device, default_work(device, volume, small_scene(function)));
      }
    }
  });
}

}  // namespace
}  // namespace triptych::contract
