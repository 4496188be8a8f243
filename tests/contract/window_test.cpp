// Tests value windows and logarithmic mappings in the units of the data, on every API.

#include <cmath>
#include <cstring>

#include "scene/value_window.hpp"
#include "under_test.hpp"
#include "volume_truth.hpp"

namespace triptych::contract {
namespace {

// Returns a field whose values span `decades` decades, so that almost all of its voxels are in the
// lowest percent of the range. Its logarithm is a generated volume.
scene::Volume long_tail(double decades) {
  scene::Volume volume = scene::generate_volume("mandelbulb", {40, 40, 40});
  scene::Volume tail{.name = "tail", .size = volume.size, .type = scene::ScalarType::f32};
  tail.range_lo = std::pow(10.0, -decades);
  tail.voxels.resize(volume.voxel_count() * sizeof(float));
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
    const double x = volume.value(i) / 255;
    const auto value = static_cast<float>(std::pow(10.0, decades * (x - 1)));
    std::memcpy(tail.voxels.data() + i * sizeof(float), &value, sizeof(float));
  }
  return tail;
}

scene::Volume mapped(scene::Volume volume, std::string_view window, scene::Mapping mapping) {
  scene::set_window(volume, scene::parse_window(window), mapping);
  return volume;
}

int covered(const core::Image& image) {
  int pixels = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) pixels += image.pixel(x, y)[3] > 0;
  }
  return pixels;
}

TEST(Window, EveryMappingStaysWithinItsBound) {
  on_every_device([](measure::Device& device) {
    for (const auto& [window, mapping] : {std::pair{"full", scene::Mapping::logarithmic},
                                          {"1e-3..0.1", scene::Mapping::linear},
                                          {"p60..p99", scene::Mapping::linear},
                                          {"p60..p99", scene::Mapping::logarithmic}}) {
      for (const scene::Quadrature quadrature :
           {scene::Quadrature::midpoint, scene::Quadrature::cells}) {
        SCOPED_TRACE(window + std::string(" ") + std::string(name_of(mapping)) + " " +
                     std::string(name_of(quadrature)));
        scene::VolumeScene scene = small_scene("surfaces");
        scene.quadrature = quadrature;
        scene.shading.enabled = true;
        measure::Work work =
            default_work(device, mapped(long_tail(4), window, mapping), std::move(scene));
        if (quadrature == scene::Quadrature::cells) {
          std::get<measure::VolumeWork>(work.scene).options.sampler = technique::Sampler::manual;
        }
        if (device.unsupported(work)) continue;
        expect_within_bound(device, work);
      }
    }
  });
}

// The logarithm removes the long tail, except for the rounding of floats: the rounded values span a
// factor of 10⁴, so a relative rounding error of 2⁻²⁴ becomes an error of 2⁻²⁴/ln 10⁴ of the range
// of the logarithm. Storing the logarithm rounds by another 2⁻²⁵ of its range.
TEST(Window, ALogarithmRevealsWhatALongTailHides) {
  on_every_device([](measure::Device& device) {
    const core::Image hidden =
        draw(device, default_work(device, long_tail(4), small_scene("haze")));
    const measure::Work work = default_work(
        device, mapped(long_tail(4), "full", scene::Mapping::logarithmic), small_scene("haze"));
    const core::Image shown = draw(device, work);
    EXPECT_LT(4 * covered(hidden), 3 * covered(shown));

    const auto& volume = std::get<measure::VolumeWork>(work.scene);
    scene::VolumeScene plain = volume.scene;
    plain.grid = std::make_shared<const scene::VoxelGrid>(
        scene::encode(scene::generate_volume("mandelbulb", {40, 40, 40}), scene::VoxelFormat::u8));
    const reference::ErrorModel model = volume_suite::error_model(
        plain, {.ert = volume.options.ert,
                .filter_weight_error =
                    device.filter_weight_error({volume.scene.grid->format, volume.options.sampler}),
                .storage_step = 2 * (0x1.0p-25 + 0x1.0p-24 / std::log(1e4))});
    const reference::Truth truth = reference::render_volume(plain, model);
    for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
      ASSERT_NEAR(shown.rgba[i], truth.rgba[i], truth.bound[i / 4]) << i;
    }
  });
}

}  // namespace
}  // namespace triptych::contract
