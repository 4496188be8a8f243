// Pictures against the truth, within the derived bound, on the default path and on every other.

#include <cmath>

#include "data_folder.hpp"
#include "reference/volume.hpp"
#include "suites/volume/tolerance.hpp"
#include "under_test.hpp"

namespace triptych::contract {
namespace {

using measure::VolumeWork;

void expect_within_bound(measure::Device& device, const measure::Work& work) {
  const VolumeWork& volume = std::get<VolumeWork>(work.scene);
  const measure::VolumePath path{volume.scene.grid->format, volume.options.sampler};
  const reference::Truth truth = reference::render_volume(
      volume.scene, volume_suite::error_model(
                        volume.scene, {.ert = volume.options.ert,
                                       .filter_weight_error = device.filter_weight_error(path)}));
  const core::Image image = draw(device, work);
  for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
    ASSERT_LE(std::abs(static_cast<double>(image.rgba[i]) - truth.rgba[i]), truth.bound[i / 4])
        << "pixel " << i / 4 % 64 << ' ' << i / 4 / 64 << " channel " << i % 4;
  }
}

TEST(Truth, EveryPathStaysWithinItsBound) {
  on_every_device([](measure::Device& device) {
    for (const scene::VoxelFormat format :
         {scene::VoxelFormat::u8, scene::VoxelFormat::u16, scene::VoxelFormat::f32}) {
      for (const technique::Sampler sampler :
           {technique::Sampler::hardware, technique::Sampler::manual}) {
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

TEST(Truth, RealVolumesStayWithinTheBound) {
  const auto files = real_volumes();
  if (files.empty()) GTEST_SKIP() << "TRIPTYCH_DATA names no folder with volumes/";
  on_every_device([&](measure::Device& device) {
    for (const auto& file : files) {
      for (const std::string_view function : scene::transfer_function_presets()) {
        SCOPED_TRACE(file.filename().string() + " " + std::string(function));
        expect_within_bound(
            device, default_work(device, scene::load_volume(file.string()), small_scene(function)));
      }
    }
  });
}

}  // namespace
}  // namespace triptych::contract
