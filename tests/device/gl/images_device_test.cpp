// Compares images of volumes with the reference image within the suite's bound, and with each
// other.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "reference/volume.hpp"
#include "suites/volume/tolerance.hpp"
#include "tests/device/gl/gl_devices.hpp"

namespace triptych::gl_backend {
namespace {

using scene::VoxelFormat;
using technique::Fault;
using technique::RaycastOptions;
using technique::Sampler;
using technique::Skip;

// The number of pixels outside of the bound, and the error of the worst pixel.
struct Verdict {
  int outside = 0;
  double worst = 0;
};

// Returns the suite's error model. An 8-bit filter also rounds its result. That rounding error does
// not shrink with the difference between voxels. The probe that measures the filter uses the
// largest possible difference, so it cannot distinguish the rounding error from an error in the
// weights. Therefore the error that the probe found is allowed for both.
reference::ErrorModel error_model(const scene::VolumeScene& scene, double ert,
                                  double filter_error) {
  reference::ErrorModel model =
      volume_suite::error_model(scene, {.ert = ert, .filter_weight_error = filter_error});
  model.value_error += model.filter_weight_error;
  return model;
}

Verdict against_truth(measure::Device& device, std::string_view technique,
                      const scene::VolumeScene& scene, const RaycastOptions& options) {
  const double filter_error = device.filter_weight_error({scene.grid->format, options.sampler});
  const reference::Truth truth =
      reference::render_volume(scene, error_model(scene, options.ert, filter_error));
  const core::Image image = draw_image(device, make_work(technique, scene, options));
  EXPECT_EQ(image.width, scene.width);
  EXPECT_EQ(image.height, scene.height);
  Verdict verdict;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    const double error = std::abs(static_cast<double>(image.rgba[i]) - truth.rgba[i]);
    verdict.worst = error <= verdict.worst ? verdict.worst : error;
    if (!(error <= truth.bound[i / 4])) ++verdict.outside;
  }
  return verdict;
}

TEST(GlImages, EveryFormatAndSamplerStaysWithinTheBound) {
  for_each_device([](measure::Device& device) {
    for (const VoxelFormat voxel :
         {VoxelFormat::u8, VoxelFormat::u16, VoxelFormat::f32, VoxelFormat::f16}) {
      for (const Sampler sampler : {Sampler::manual, Sampler::hardware}) {
        for (const std::string_view technique : image_techniques) {
          const scene::VolumeScene scene = make_scene({.voxel = voxel});
          const Verdict verdict =
              against_truth(device, technique, scene, {.sampler = sampler, .ert = 0});
          EXPECT_EQ(verdict.outside, 0) << technique << ' ' << scene::name_of(voxel) << ' '
                                        << technique::name_of(sampler) << ": " << verdict.worst;
        }
      }
    }
  });
}

TEST(GlImages, ShadingAndStepsStayWithinTheBound) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : image_techniques) {
      for (const double step : {0.25, 1.0, 7.0, 1000.0}) {
        const scene::VolumeScene scene = make_scene({.step_voxels = step, .shading = true});
        EXPECT_EQ(against_truth(device, technique, scene, {}).outside, 0) << technique << step;
      }
    }
  });
}

TEST(GlImages, AwkwardVolumesStayWithinTheBound) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : image_techniques) {
      for (const char* size : {"1x1x1", "2x2x2", "23x23x1", "1x1x17", "7x11x13"}) {
        const std::string data = fmt::format("generate:gradient_box:{}", size);
        for (const auto& [voxel, sampler] : {std::pair{VoxelFormat::u8, Sampler::manual},
                                             {VoxelFormat::u16, Sampler::hardware},
                                             {VoxelFormat::f32, Sampler::hardware}}) {
          const scene::VolumeScene scene = make_scene(
              {.data = data, .transfer_function = "haze", .camera = "random:3", .voxel = voxel});
          const Verdict verdict =
              against_truth(device, technique, scene, {.sampler = sampler, .ert = 0});
          EXPECT_EQ(verdict.outside, 0) << technique << ' ' << data << ' ' << verdict.worst;
        }
      }
    }
  });
}

TEST(GlImages, AwkwardCamerasStayWithinTheBound) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : image_techniques) {
      scene::VolumeScene scene =
          make_scene({.data = "generate:gradient_box:24", .transfer_function = "haze"});
      const double edge = scene.box().hi.x;
      const glm::dvec3 centre{edge / 2, edge / 2, edge / 2};
      // The view is along an axis and has an odd number of pixels, so that the middle rays have
      // components of exactly 0.
      for (const glm::dvec3 eye :
           {centre, glm::dvec3{0, 0, 0}, glm::dvec3{edge, centre.y, edge},
            glm::dvec3{centre.x, centre.y, 2 * edge}, glm::dvec3{centre.x, centre.y, -edge}}) {
        scene.camera.eye = eye;
        scene.camera.forward = {0, 0, -1};
        scene.camera.up = {0, 1, 0};
        for (const auto& [width, height] : {std::pair{33, 29}, {1, 1}, {17, 13}, {1, 40}}) {
          scene.width = width;
          scene.height = height;
          for (const Skip skip : {Skip::none, Skip::bricks}) {
            EXPECT_EQ(against_truth(device, technique, scene,
                                    {.sampler = Sampler::hardware, .skip = skip, .ert = 0})
                          .outside,
                      0)
                << technique
                << fmt::format(" eye {} {} {}, {}x{}", eye.x, eye.y, eye.z, width, height);
          }
        }
      }
    }
  });
}

TEST(GlImages, SkippingIsBitIdentical) {
  for_each_device([](measure::Device& device) {
    for (const char* data : {"generate:mandelbulb:40", "generate:sparse_field:37",
                             "generate:nested_shells:32", "generate:frequency_box:24"}) {
      for (const std::string_view preset : scene::transfer_function_presets()) {
        const scene::VolumeScene scene = make_scene({.data = data, .transfer_function = preset});
        for (const std::string_view technique : image_techniques) {
          for (const Sampler sampler : {Sampler::manual, Sampler::hardware}) {
            const auto draw = [&](Skip skip) {
              return draw_image(device, make_work(technique, scene,
                                                  {.sampler = sampler, .skip = skip, .ert = 0}));
            };
            EXPECT_EQ(draw(Skip::bricks), draw(Skip::none))
                << data << ' ' << preset << ' ' << technique;
          }
        }
      }
    }
  });
}

TEST(GlImages, FragmentAndComputeDifferOnlyByRounding) {
  for_each_device([](measure::Device& device) {
    for (const bool shading : {false, true}) {
      const scene::VolumeScene scene = make_scene({.width = 40, .height = 24, .shading = shading});
      const core::Image compute = draw_image(device, make_work("raycast", scene, {.ert = 0}));
      const core::Image fragment =
          draw_image(device, make_work("raycast_fragment", scene, {.ert = 0}));
      EXPECT_LT(largest_difference(compute, fragment), 1e-4);
    }
  });
}

TEST(GlImages, RepeatedFramesAreBitIdentical) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : image_techniques) {
      const auto prepared = device.prepare(make_work(technique, make_scene({})));
      static_cast<void>(prepared->frame(measure::Purpose::timing));
      const core::Image first = prepared->image();
      for (int i = 0; i < 20; ++i) {
        static_cast<void>(prepared->frame(measure::Purpose::timing));
        ASSERT_EQ(prepared->image(), first);
      }
    }
  });
}

TEST(GlImages, InjectedFaultsExceedTheBound) {
  // A sampler with a larger error than this is skipped, because its bound would be so wide that it
  // hides faults.
  constexpr double coarse = 1.0 / 64;
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : image_techniques) {
      for (const Sampler sampler : {Sampler::manual, Sampler::hardware}) {
        if (device.filter_weight_error({VoxelFormat::f32, sampler}) > coarse) continue;
        for (const Fault fault : {Fault::half_voxel_shift, Fault::flipped_axis, Fault::extra_sample,
                                  Fault::uncorrected_opacity, Fault::coarse_filter}) {
          const scene::VolumeScene scene =
              make_scene({.data = "generate:gradient_box:24", .transfer_function = "haze"});
          const Verdict verdict = against_truth(device, technique, scene,
                                                {.sampler = sampler, .ert = 0, .fault = fault});
          EXPECT_GT(verdict.outside, 0)
              << technique << " fault " << static_cast<int>(fault) << ": " << verdict.worst;
        }
      }
    }
  });
}

}  // namespace
}  // namespace triptych::gl_backend
