// Compares images of volumes with the reference image, and with each other.
#include <gmock/gmock.h>

#include <cstdio>

#include "reference/volume.hpp"
#include "suites/volume/tolerance.hpp"
#include "tests/device/opencl/opencl_devices.hpp"

namespace triptych::opencl_backend {
namespace {

using scene::VoxelFormat;
using technique::Fault;
using technique::Sampler;
using technique::Skip;

struct Path {
  VoxelFormat voxel;
  Sampler sampler;
};
constexpr std::array<Path, 7> paths{{{VoxelFormat::u8, Sampler::manual},
                                     {VoxelFormat::u16, Sampler::manual},
                                     {VoxelFormat::f32, Sampler::manual},
                                     {VoxelFormat::u8, Sampler::hardware},
                                     {VoxelFormat::u16, Sampler::hardware},
                                     {VoxelFormat::f32, Sampler::hardware},
                                     {VoxelFormat::f16, Sampler::manual}}};

struct Distance {
  double error = 0;  // the largest error of all channels
  double share = 0;  // the largest ratio of an error to the bound of its pixel
};

// Returns the distance from the reference image. It is infinite if the sizes differ or if a value
// is not finite.
Distance from_truth(const core::Image& image, const reference::Truth& truth) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (image.width != truth.width || image.height != truth.height) return {infinite, infinite};
  Distance distance;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    const double error = std::abs(static_cast<double>(image.rgba[i]) - truth.rgba[i]);
    if (!std::isfinite(error)) return {infinite, infinite};
    distance.error = std::max(distance.error, error);
    distance.share = std::max(distance.share, error / truth.bound[i / 4]);
  }
  return distance;
}

// Draws the scene and compares it with the reference image, within the suite's bound.
Distance against_truth(measure::Device& device, const scene::VolumeScene& scene,
                       const technique::RaycastOptions& options) {
  const reference::ErrorModel model = volume_suite::error_model(
      scene,
      {.ert = options.ert,
       .filter_weight_error = device.filter_weight_error({scene.grid->format, options.sampler})});
  return from_truth(draw_image(device, make_work("raycast", scene, options)),
                    reference::render_volume(scene, model));
}

TEST(OpenClImages, StayWithinTheBound) {
  for_each_device([](measure::Device& device) {
    for (const auto& [voxel, sampler] : paths) {
      Distance worst;
      for (const std::string_view data :
           {"generate:mandelbulb:40", "generate:frequency_box:37x23x41",
            "generate:nested_shells:48"}) {
        for (const std::string_view function : {"haze", "surfaces"}) {
          for (const bool shading : {false, true}) {
            const scene::VolumeScene scene = make_scene({.data = data,
                                                         .transfer_function = function,
                                                         .camera = "random:5",
                                                         .voxel = voxel,
                                                         .shading = shading});
            const Distance each = against_truth(device, scene, {.sampler = sampler, .ert = 0});
            EXPECT_LE(each.share, 1)
                << data << ' ' << function << ' ' << scene::name_of(voxel) << ' '
                << technique::name_of(sampler) << " shading " << shading << " error " << each.error;
            worst.error = std::max(worst.error, each.error);
            worst.share = std::max(worst.share, each.share);
          }
        }
      }
      std::printf("%s %s %s: largest error %.3g, %.2f of its bound\n", device.info().id.c_str(),
                  std::string(scene::name_of(voxel)).c_str(),
                  std::string(technique::name_of(sampler)).c_str(), worst.error, worst.share);
    }
  });
}

TEST(OpenClImages, SkippingIsBitIdentical) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view data :
         {"generate:mandelbulb:40", "generate:sparse_field:67x31x40", "generate:nested_shells:33",
          "generate:marschner_lobb:24", "generate:gaussian_blob:29"}) {
      for (const std::string_view function : {"haze", "surfaces"}) {
        for (const auto& [voxel, sampler] : paths) {
          const scene::VolumeScene scene = make_scene(
              {.data = data, .transfer_function = function, .camera = "random:11", .voxel = voxel});
          const auto draw = [&](Skip skip) {
            return draw_image(device,
                              make_work("raycast", scene, {.sampler = sampler, .skip = skip}));
          };
          EXPECT_EQ(draw(Skip::none), draw(Skip::bricks))
              << data << ' ' << function << ' ' << scene::name_of(voxel) << ' '
              << technique::name_of(sampler);
        }
      }
    }
  });
}

// Tests a volume of one voxel, one of one layer and one of one row, and viewports that are not
// multiples of the work-group size.
TEST(OpenClImages, ThinVolumesAndOddViewports) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view data : {"generate:uniform_box:1", "generate:gradient_box:9x9x1",
                                        "generate:gradient_box:1x17x1", "generate:mandelbulb:2"}) {
      for (const auto& [width, height] : {std::pair{1, 1}, std::pair{17, 13}, std::pair{1, 40}}) {
        for (const Sampler sampler : {Sampler::manual, Sampler::hardware}) {
          const scene::VolumeScene scene = make_scene({.data = data,
                                                       .transfer_function = "haze",
                                                       .camera = "diagonal_xyz:1/5",
                                                       .width = width,
                                                       .height = height,
                                                       .step_voxels = 0.21,
                                                       .shading = true});
          const Distance distance = against_truth(device, scene, {.sampler = sampler, .ert = 0});
          EXPECT_LE(distance.share, 1)
              << data << ' ' << width << 'x' << height << ' ' << technique::name_of(sampler)
              << " error " << distance.error;
        }
      }
    }
  });
}

TEST(OpenClImages, CamerasInsideAndAlongAxes) {
  for_each_device([](measure::Device& device) {
    scene::VolumeScene scene = make_scene({.transfer_function = "haze", .width = 17, .height = 17});
    struct View {
      glm::dvec3 eye;
      glm::dvec3 forward;
    };
    // Viewports have odd sizes, so that the ray of the middle pixel has components of exactly 0.
    // The second eye is on a face plane of the volume, and the third is in a corner.
    for (const auto& [eye, forward] :
         {View{{20, 20, 20}, {0, 0, -1}}, View{{0, 20, 60}, {0, 0, -1}}, View{{0, 0, 0}, {0, 0, 1}},
          View{{-30, 20, 20}, {1, 0, 0}}, View{{20, 20, 90}, {0, 0, 1}}}) {
      scene.camera.eye = eye;
      scene.camera.forward = forward;
      const technique::RaycastOptions plain{.skip = Skip::none, .ert = 0};
      EXPECT_LE(against_truth(device, scene, plain).share, 1)
          << eye.x << ' ' << eye.y << ' ' << eye.z;
      technique::RaycastOptions skipping = plain;
      skipping.skip = Skip::bricks;
      EXPECT_EQ(draw_image(device, make_work("raycast", scene, plain)),
                draw_image(device, make_work("raycast", scene, skipping)));
    }
  });
}

TEST(OpenClImages, RaysThatMissShowExactlyTheBackground) {
  for_each_device([](measure::Device& device) {
    scene::VolumeScene scene = make_scene({});
    scene.camera.forward = -scene.camera.forward;
    for (const float channel : draw_image(device, make_work("raycast", scene)).rgba) {
      EXPECT_THAT(channel, testing::AnyOf(0.1F, 0.2F, 0.3F, 1.0F));
    }
  });
}

TEST(OpenClImages, EarlyTerminationStaysWithinItsErrorBudget) {
  for_each_device([](measure::Device& device) {
    const scene::VolumeScene scene = make_scene({.data = "generate:nested_shells:48"});
    const core::Image whole = draw_image(device, make_work("raycast", scene, {.ert = 0}));
    for (const double ert : {1.0 / 50, 1.0 / 512, 1e-6}) {
      const core::Image cut = draw_image(device, make_work("raycast", scene, {.ert = ert}));
      EXPECT_LE(largest_difference(cut, whole), ert);
      if (ert > 0.01) {
        EXPECT_GT(largest_difference(cut, whole), 0);
      }
    }
  });
}

TEST(OpenClImages, InjectedFaultsExceedTheBound) {
  for_each_device([](measure::Device& device) {
    for (const Sampler sampler : {Sampler::manual, Sampler::hardware}) {
      for (const Fault fault : {Fault::half_voxel_shift, Fault::flipped_axis, Fault::extra_sample,
                                Fault::uncorrected_opacity, Fault::coarse_filter}) {
        // With haze, an additional sample beyond the far face is visible. With surfaces, steep
        // edges reveal slightly wrong weights.
        const bool subtle = fault == Fault::coarse_filter;
        const scene::VolumeScene scene =
            make_scene({.data = "generate:frequency_box:40",
                        .transfer_function = subtle ? "surfaces" : "haze",
                        .camera = "random:5"});
        const Distance distance = against_truth(
            device, scene, {.sampler = sampler, .skip = Skip::none, .ert = 0, .fault = fault});
        EXPECT_GT(distance.share, 1)
            << "fault " << static_cast<int>(fault) << ' ' << technique::name_of(sampler);
      }
    }
  });
}

TEST(OpenClImages, AHundredFramesAreBitIdentical) {
  for_each_device([](measure::Device& device) {
    const auto prepared = device.prepare(make_work("raycast", make_scene({.shading = true})));
    static_cast<void>(prepared->frame(measure::Purpose::timing));
    const core::Image first = prepared->image();
    for (int i = 0; i < 100; ++i) {
      static_cast<void>(prepared->frame(measure::Purpose::timing));
      ASSERT_EQ(prepared->image(), first) << "frame " << i;
    }
  });
}

}  // namespace
}  // namespace triptych::opencl_backend
