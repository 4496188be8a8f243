// Compares images of volumes with the reference image within the suite's bound, and with each
// other.
#include <fmt/format.h>

#include "reference/volume.hpp"
#include "scene/generators.hpp"
#include "suites/volume/tolerance.hpp"
#include "tests/device/vulkan/vulkan_devices.hpp"

namespace triptych::vulkan_backend {
namespace {

using scene::VoxelFormat;
using technique::Fault;
using technique::RaycastOptions;
using technique::Sampler;
using technique::Skip;

struct Verdict {
  int outside = 0;  // number of channels that exceed the bound of their pixel
  double worst = 0;
};

Verdict judge(const core::Image& image, const reference::Truth& truth) {
  EXPECT_EQ(image.rgba.size(), truth.rgba.size());
  Verdict verdict;
  for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
    const double error = std::abs(static_cast<double>(image.rgba.at(i)) - truth.rgba[i]);
    if (!(error <= truth.bound[i / 4])) ++verdict.outside;
    if (!(error <= verdict.worst)) verdict.worst = error;
  }
  return verdict;
}

reference::Truth truth_of(const measure::Device& device, const scene::VolumeScene& scene,
                          const RaycastOptions& options) {
  const double filter = device.filter_weight_error({scene.grid->format, options.sampler});
  reference::ErrorModel model =
      volume_suite::error_model(scene, {.ert = options.ert, .filter_weight_error = filter});
  // An 8-bit filter also rounds its result, regardless of the difference between the voxels. The
  // error that the probe found is therefore allowed for the value, too.
  if (filter > 1e-5) model.value_error += filter;
  return reference::render_volume(scene, model);
}

void expect_truth(measure::Device& device, const scene::VolumeScene& scene,
                  const RaycastOptions& options, const std::string& what) {
  const reference::Truth truth = truth_of(device, scene, options);
  for (const std::string_view technique : image_techniques) {
    const Verdict verdict = judge(draw_image(device, make_work(technique, scene, options)), truth);
    EXPECT_EQ(verdict.outside, 0) << technique << ' ' << what << ": worst " << verdict.worst;
  }
}

TEST(VulkanImages, EveryFormatAndSamplerIsWithinTheBound) {
  for_each_device([](measure::Device& device) {
    for (const VoxelFormat voxel :
         {VoxelFormat::u8, VoxelFormat::u16, VoxelFormat::f32, VoxelFormat::f16}) {
      for (const Sampler sampler : {Sampler::manual, Sampler::hardware}) {
        expect_truth(device, make_scene({.voxel = voxel}), {.sampler = sampler},
                     fmt::format("{} {}", scene::name_of(voxel), technique::name_of(sampler)));
      }
    }
  });
}

// Tests every closed-form expression for the opacity of a step, the general expression, and steps
// that are longer than the volume.
TEST(VulkanImages, EveryStepSizeIsWithinTheBound) {
  for_each_device([](measure::Device& device) {
    for (const double step : {0.0625, 0.125, 0.25, 0.5, 0.7, 1.0, 2.0, 3.0, 4.0, 8.0, 1000.0}) {
      for (const bool shading : {false, true}) {
        expect_truth(device, make_scene({.step_voxels = step, .shading = shading}),
                     {.sampler = Sampler::hardware}, fmt::format("step {} {}", step, shading));
      }
    }
  });
}

TEST(VulkanImages, ThinVolumesAndOddViewports) {
  for_each_device([](measure::Device& device) {
    for (const char* size : {"1x1x1", "2x2x2", "24x24x1", "1x24x24", "1x1x31", "7x11x13"}) {
      const std::string data = fmt::format("generate:gradient_box:{}", size);
      for (const auto& [width, height] : {std::pair{1, 1}, {17, 13}, {1, 40}}) {
        scene::VolumeScene scene =
            make_scene({.data = data, .transfer_function = "haze", .camera = "random:7"});
        scene.width = width;
        scene.height = height;
        expect_truth(device, scene, {}, fmt::format("{} {}x{}", size, width, height));
      }
    }
  });
}

TEST(VulkanImages, CamerasInsideOnFacesAndAlongAxes) {
  for_each_device([](measure::Device& device) {
    scene::VolumeScene scene = make_scene({.transfer_function = "haze"});
    const double edge = scene.box().hi.x;
    const double half = edge / 2;
    for (const glm::dvec3 eye :
         {glm::dvec3{half, half, half}, glm::dvec3{0, 0, 0}, glm::dvec3{edge, half, edge},
          glm::dvec3{half, half, 2 * edge}, glm::dvec3{half, half, -edge}}) {
      scene.camera.eye = eye;
      // The view is along an axis, and width and height are odd, so that the rays of the middle row
      // and the middle column have components of 0.
      scene.camera.forward = {0, 0, -1};
      scene.camera.up = {0, 1, 0};
      scene.width = 17;
      scene.height = 13;
      for (const Skip skip : {Skip::none, Skip::bricks}) {
        expect_truth(device, scene, {.skip = skip},
                     fmt::format("eye {} {} {}", eye.x, eye.y, eye.z));
      }
    }
  });
}

TEST(VulkanImages, SkippingIsBitIdentical) {
  for_each_device([](measure::Device& device) {
    for (const scene::GeneratorInfo& generator : scene::volume_generators()) {
      for (const std::string_view preset : scene::transfer_function_presets()) {
        const scene::VolumeScene scene =
            make_scene({.data = fmt::format("generate:{}:37", generator.name),
                        .transfer_function = preset,
                        .camera = "random:5"});
        for (const std::string_view technique : image_techniques) {
          for (const Sampler sampler : {Sampler::manual, Sampler::hardware}) {
            for (const double ert : {0.0, 1.0 / 512}) {
              const auto draw = [&](Skip skip) {
                return draw_image(
                    device,
                    make_work(technique, scene, {.sampler = sampler, .skip = skip, .ert = ert}));
              };
              EXPECT_EQ(draw(Skip::bricks), draw(Skip::none))
                  << generator.name << ' ' << preset << ' ' << technique;
            }
          }
        }
      }
    }
  });
}

TEST(VulkanImages, FragmentAndComputeDifferOnlyByRounding) {
  for_each_device([](measure::Device& device) {
    for (const bool shading : {false, true}) {
      const scene::VolumeScene scene = make_scene({.shading = shading});
      const core::Image compute = draw_image(device, make_work("raycast", scene, {.ert = 0}));
      const core::Image fragment =
          draw_image(device, make_work("raycast_fragment", scene, {.ert = 0}));
      for (std::size_t i = 0; i < compute.rgba.size(); ++i) {
        ASSERT_NEAR(compute.rgba[i], fragment.rgba.at(i), 1e-5) << "channel " << i;
      }
    }
  });
}

TEST(VulkanImages, RaysThatMissShowExactlyTheBackground) {
  for_each_device([](measure::Device& device) {
    scene::VolumeScene scene = make_scene();
    scene.camera.forward = -scene.camera.forward;
    for (const std::string_view technique : image_techniques) {
      const core::Image image = draw_image(device, make_work(technique, scene));
      for (int x = 0; x < image.width; ++x) EXPECT_EQ(image.pixel(x, 3), scene.background);
    }
  });
}

TEST(VulkanImages, RepeatedFramesAreBitIdentical) {
  for_each_device([](measure::Device& device) {
    for (const std::string_view technique : image_techniques) {
      const auto prepared = device.prepare(make_work(technique, make_scene()));
      static_cast<void>(prepared->frame(measure::Purpose::timing));
      const core::Image first = prepared->image();
      for (int i = 0; i < 20; ++i) {
        static_cast<void>(prepared->frame(measure::Purpose::timing));
        ASSERT_EQ(prepared->image(), first);
      }
    }
  });
}

TEST(VulkanImages, SpeedOfLightReadsTheSameSamplesAsRaycast) {
  for_each_device([](measure::Device& device) {
    // All table entries are equal, so every sample adds the same colour, and the sums are
    // proportional to the number of samples.
    scene::VolumeScene scene = make_scene({.transfer_function = "haze"});
    scene.transfer_function.entries.fill({1, 0.5F, 0.25F, 0.125F});
    scene.background = {};
    const RaycastOptions options{.skip = Skip::none, .ert = 0};
    const auto light = device.prepare(make_work("speed_of_light", scene, options));
    const measure::Frame counted = light->frame(measure::Purpose::counters);
    static_cast<void>(light->frame(measure::Purpose::timing));
    const core::Image image = light->image();
    double red = 0;
    double alpha = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
      red += static_cast<double>(image.rgba[i]);
      // speed_of_light adds each α to the transmittance, so the alpha of a pixel is −Σ α.
      alpha -= static_cast<double>(image.rgba[i + 3]);
    }
    EXPECT_EQ(red, static_cast<double>(counted.counts.at("samples")));
    EXPECT_EQ(alpha, red / 8);
    const auto raycast = device.prepare(make_work("raycast", scene, options));
    EXPECT_EQ(raycast->frame(measure::Purpose::counters).counts.at("samples"),
              counted.counts.at("samples"));
  });
}

TEST(VulkanImages, InjectedFaultsExceedTheBound) {
  for_each_device([](measure::Device& device) {
    const scene::VolumeScene scene =
        make_scene({.data = "generate:gradient_box:24", .transfer_function = "haze"});
    for (const Sampler sampler : {Sampler::manual, Sampler::hardware}) {
      for (const Fault fault : {Fault::half_voxel_shift, Fault::flipped_axis, Fault::extra_sample,
                                Fault::uncorrected_opacity, Fault::coarse_filter}) {
        const RaycastOptions options{.sampler = sampler, .ert = 0, .fault = fault};
        const reference::Truth truth = truth_of(device, scene, options);
        for (const std::string_view technique : image_techniques) {
          const Verdict verdict =
              judge(draw_image(device, make_work(technique, scene, options)), truth);
          EXPECT_GT(verdict.outside, 0) << technique << " fault " << static_cast<int>(fault);
        }
      }
    }
  });
}

}  // namespace
}  // namespace triptych::vulkan_backend
