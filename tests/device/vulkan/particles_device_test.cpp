// Compares particles drawn by every technique with the reference image, and tests the other results
// of particle frames.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include "core/error.hpp"
#include "reference/spheres.hpp"
#include "scene/particle_generators.hpp"
#include "technique/particles/option_reason.hpp"
#include "tests/device/vulkan/vulkan_devices.hpp"

namespace triptych::vulkan_backend {
namespace {

using measure::Purpose;
using technique::Culling;
using technique::ParticleFault;
using technique::ParticleOptions;

constexpr std::array<std::string_view, 8> techniques{
    "quad_screen",  "quad_ray",         "quad_instanced", "quad_tess",
    "polygon_tess", "polygon_adaptive", "point",          "tiles"};

scene::ParticleScene look_at(std::shared_ptr<const scene::ParticleSet> set, const glm::dvec3& eye,
                             const glm::dvec3& forward, double fov) {
  scene::ParticleScene scene;
  scene.particles = std::move(set);
  scene.intensity_colours = scene::load_transfer_function("surfaces");
  scene.camera.eye = eye;
  scene.camera.forward = glm::normalize(forward);
  const glm::dvec3 side =
      std::abs(scene.camera.forward.y) > 0.9 ? glm::dvec3{0, 0, 1} : glm::dvec3{0, 1, 0};
  scene.camera.up =
      glm::normalize(side - glm::dot(side, scene.camera.forward) * scene.camera.forward);
  scene.camera.fov_y_deg = fov;
  scene.camera.near = scene::depth_scale(scene::bounding_box(*scene.particles), eye);
  scene.width = 61;
  scene.height = 45;
  scene.background = {0.05F, 0.1F, 0.2F, 0.5F};
  return scene;
}

std::shared_ptr<const scene::ParticleSet> spheres(
    const std::vector<std::array<double, 4>>& centres) {
  scene::ParticleSet set{.name = "spheres"};
  for (std::uint32_t i = 0; i < centres.size(); ++i) {
    if (scene::append(set, centres[i], i)) set.rgba8.push_back(0xFF000000U + 0x30507U * (i + 1));
  }
  set.hash = scene::particle_hash(set);
  return std::make_shared<const scene::ParticleSet>(std::move(set));
}

scene::ParticleScene generated(std::string_view name, std::uint64_t count,
                               std::string_view camera = "orbit_y:1/8",
                               scene::ColourKind colour = scene::ColourKind::rgba8) {
  const auto set =
      std::make_shared<const scene::ParticleSet>(scene::generate_particles(name, count, colour));
  const scene::Camera view = scene::particle_camera(camera, *set, 60);
  scene::ParticleScene scene = look_at(set, view.eye, view.forward, 60);
  scene.camera = view;
  return scene;
}

measure::Work particle_work(std::string_view technique, const scene::ParticleScene& scene,
                            const ParticleOptions& options) {
  return {std::string(technique), measure::ParticleWork{scene, options}};
}

// Allows for a few rounding errors of single precision in the ray and in the position of the
// sphere.
constexpr reference::SphereErrorModel bounds{
    .lateral_px = 1e-4, .lateral_relative = 2e-7, .depth_relative = 2e-6};

// Returns the number of wrong pixels among those for which the reference renderer is certain which
// sphere is visible. A pixel is wrong if its id differs from the reference image, or if its
// distance differs by more than the rounding error of single precision.
int wrong_pixels(const core::Image& image, const reference::SphereTruth& truth) {
  int wrong = 0;
  for (std::size_t i = 0; i < truth.ids.size(); ++i) {
    if (truth.certain[i] == 0) continue;
    const double z = static_cast<double>(image.depth.at(i));
    const bool none = truth.ids[i] == core::Image::no_particle;
    const bool right_depth =
        none ? std::isinf(z) && z > 0 : std::abs(z - truth.depth[i]) <= truth.depth_bound[i];
    wrong += image.ids.at(i) == truth.ids[i] && right_depth ? 0 : 1;
  }
  return wrong;
}

void expect_truth(measure::Device& device, const scene::ParticleScene& scene,
                  const ParticleOptions& options, const std::string& what) {
  const reference::SphereTruth truth = reference::render_spheres(scene, bounds, 1);
  const core::Image first = draw_image(device, particle_work(techniques[0], scene, options));
  for (const std::string_view technique : techniques) {
    const measure::Work work = particle_work(technique, scene, options);
    if (technique::option_reason(technique, options, technique::SpriteRasterizer::api)) {
      EXPECT_TRUE(device.unsupported(work)) << technique << ' ' << what;
      continue;
    }
    const core::Image image = draw_image(device, work);
    EXPECT_EQ(wrong_pixels(image, truth), 0) << technique << ' ' << what;
    if (options.ray == technique::ComputedAt::pixel) {
      EXPECT_EQ(image.ids, first.ids) << technique << ' ' << what;
      EXPECT_EQ(image.depth, first.depth) << technique << ' ' << what;
    }
    EXPECT_TRUE(std::ranges::none_of(image.rgba, [](float x) { return std::isnan(x); }))
        << technique << ' ' << what;
  }
}

TEST(VulkanParticles, NearFarInsideAndBehindTheEye) {
  for_each_device([](measure::Device& device) {
    for (const double ratio : {0.0, 0.5, 1.0001, 1.25, 2.0, 1e5}) {
      const double fov = ratio > 10 ? 0.0013 : 60;
      expect_truth(device, look_at(spheres({{0, 0, 0, 1}}), {0, 0, ratio}, {0.1, 0.05, -1}, fov),
                   {}, fmt::format("distance {} radii", ratio));
    }
    const scene::ParticleScene across =
        look_at(spheres({{0, 0, 0, 1}, {2, 0.3, 0, 1}}), {0.95, 0, 0}, {0, 0, -1}, 90);
    expect_truth(device, across, {}, "across the plane of the eye");
    const scene::ParticleScene behind =
        look_at(spheres({{0, 0, 1, 1.5}}), {0, 1.7, 0}, {0, -0.2, -1}, 100);
    expect_truth(device, behind, {}, "centre behind, a part in front");
    const scene::ParticleScene wide = look_at(
        spheres({{3, 2, -1, 0.7}, {-6, -4, -1.2, 0.9}, {0, 0, -3, 1}}), {0, 0, 0}, {0, 0, -1}, 150);
    expect_truth(device, wide, {}, "field of view 150");
  });
}

TEST(VulkanParticles, ParticleCountsAroundTheWorkGroupSize) {
  for_each_device([](measure::Device& device) {
    for (const std::uint32_t count : {1U, 63U, 64U, 65U, 511U, 513U}) {
      expect_truth(device, generated("uniform", count), {}, fmt::format("{} particles", count));
    }
    scene::ParticleScene nothing = look_at(spheres({}), {0, 0, 3}, {0, 0, -1}, 60);
    expect_truth(device, nothing, {}, "no particles");
    scene::ParticleScene away = generated("uniform", 700);
    away.camera.forward = -away.camera.forward;
    for (const Culling culling : {Culling::none, Culling::frustum, Culling::occlusion}) {
      expect_truth(device, away, {.culling = culling}, "looking away");
    }
  });
}

TEST(VulkanParticles, ColoursStagesAndCornersLeaveIdsUnchanged) {
  for_each_device([](measure::Device& device) {
    using technique::ComputedAt;
    for (const auto colour : {scene::ColourKind::rgba32, scene::ColourKind::intensity}) {
      const scene::ParticleScene scene = generated("plume", 900, "random:5", colour);
      for (const auto transfer : {ComputedAt::vertex, ComputedAt::pixel}) {
        const ParticleOptions options{.transfer = transfer,
                                      .conservative_depth = transfer == ComputedAt::pixel};
        expect_truth(device, scene, options, "colours");
        const core::Image first = draw_image(device, particle_work("quad_ray", scene, options));
        for (const std::string_view technique : techniques) {
          const core::Image image = draw_image(device, particle_work(technique, scene, options));
          for (std::size_t i = 0; i < image.rgba.size(); ++i) {
            ASSERT_NEAR(image.rgba[i], first.rgba.at(i), 1e-5) << technique;
          }
        }
      }
    }
    const scene::ParticleScene scene = generated("droplets", 600);
    expect_truth(device, scene, {.ray = ComputedAt::vertex}, "rays at vertices");
    for (const int corners : {4, 5, 6, 7, 8, 16, 32}) {
      const core::Image image =
          draw_image(device, particle_work("polygon_tess", scene, {.corners = corners}));
      EXPECT_EQ(image.ids, draw_image(device, particle_work("quad_ray", scene, {})).ids) << corners;
    }
  });
}

TEST(VulkanParticles, TiesAndLargeSpheresAmongSmallOnes) {
  for_each_device([](measure::Device& device) {
    expect_truth(device, generated("coincident", 800, "random:3"), {}, "coincident");
    scene::ParticleScene scene = generated("uniform", 3000, "path_z:3/10");
    scene.radius_scale = 2;
    expect_truth(device, scene, {}, "many sizes");
  });
}

// Draws a sphere that intersects the plane of the eye and is visible only on the right. The sprite
// of `point` must be only as large as the sphere's projection, regardless of whether the device's
// points are large enough.
TEST(VulkanParticles, APointAcrossTheEyePlaneDoesNotFillTheViewport) {
  for_each_device([](measure::Device& device) {
    scene::ParticleScene scene = look_at(spheres({{1.5, 0, -0.9, 1}}), {0, 0, 0}, {0, 0, -1}, 60);
    scene.width = 600;
    scene.height = 400;
    const auto prepared = device.prepare(particle_work("point", scene, {}));
    const record::Counts counts = prepared->frame(Purpose::counters).counts;
    EXPECT_EQ(counts.at("sprites"), 1U);
    EXPECT_GT(counts.at("fragments_kept"), 1000U);
    EXPECT_LE(counts.at("fragments"), 400U * 402U);
  });
}

TEST(VulkanParticles, CullingAndExtraWorkAreBitIdentical) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = generated("uniform", 20000, "path_z:5/10");
    for (const std::string_view technique : techniques) {
      const auto draw = [&](const ParticleOptions& options) {
        const auto prepared = device.prepare(particle_work(technique, scene, options));
        for (int i = 0; i < 3; ++i) static_cast<void>(prepared->frame(Purpose::timing));
        return prepared->image();
      };
      const core::Image all = draw({.culling = Culling::none});
      EXPECT_EQ(draw({.culling = Culling::frustum}), all) << technique;
      EXPECT_EQ(draw({.culling = Culling::occlusion}), all) << technique;
      EXPECT_EQ(draw({.culling = Culling::none, .extra_work_stride = 5}), all) << technique;
      EXPECT_EQ(draw({.culling = Culling::frustum, .extra_work_stride = 3}), all) << technique;
    }
  });
}

TEST(VulkanParticles, CountersAddUpAndRepeat) {
  for_each_device([](measure::Device& device) {
    scene::ParticleScene scene = generated("uniform", 20000, "path_z:5/10");
    scene.width = 240;
    scene.height = 180;
    for (const std::string_view technique : techniques) {
      std::uint64_t culled = 0;  // number of particles culled by the previous kind of culling
      for (const Culling culling : {Culling::none, Culling::frustum, Culling::occlusion}) {
        const auto prepared = device.prepare(particle_work(technique, scene, {.culling = culling}));
        const record::Counts counts = prepared->frame(Purpose::counters).counts;
        EXPECT_EQ(prepared->frame(Purpose::counters).counts, counts) << technique;
        EXPECT_EQ(counts.at("particles_submitted") + counts.at("particles_culled"), 20000U);
        EXPECT_LE(counts.at("sprites"), counts.at("particles_submitted"));
        EXPECT_EQ(counts.at("particles_culled") == 0, culling == Culling::none) << technique;
        // `tiles` draws ranges of particles in rounds, and culls only the particles that earlier
        // rounds have hidden. This scene needs few rounds, so `tiles` may cull only a few more
        // particles than with frustum culling.
        const std::uint64_t factor = technique == "tiles" ? 1 : 2;
        EXPECT_GE(counts.at("particles_culled"), factor * culled) << technique;
        culled = counts.at("particles_culled");
        EXPECT_GT(counts.at("visible_ids"), 100U);
        if (technique == "tiles") {
          EXPECT_GT(counts.at("bin_entries"), 0U);
        } else {
          EXPECT_GT(counts.at("fragments_kept"), 240U * 180U / 2) << technique;
          EXPECT_EQ(counts.at("fragments"),
                    counts.at("fragments_kept") + counts.at("fragments_discarded"));
        }
      }
    }
  });
}

TEST(VulkanParticles, StatisticsCoverExactlyTheStagesInUse) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = generated("uniform", 700);
    for (const std::string_view technique : techniques) {
      const auto prepared = device.prepare(particle_work(technique, scene, {}));
      const record::Counts counts = prepared->frame(Purpose::statistics).counts;
      if (counts.empty()) continue;  // the device has no statistics
      const bool geometry = technique == "quad_screen" || technique == "quad_ray";
      const bool tessellation =
          technique.find("tess") != std::string_view::npos || technique == "polygon_adaptive";
      EXPECT_EQ(counts.contains("geometry_primitives"), geometry) << technique;
      EXPECT_EQ(counts.contains("tessellation_control_patches"), tessellation) << technique;
      EXPECT_EQ(counts.contains("compute_invocations"), technique == "tiles") << technique;
      if (geometry || tessellation || technique == "point") {
        EXPECT_EQ(counts.at("input_assembly_vertices"), 700U) << technique;
      }
    }
  });
}

// Returns the number of pixels that an injected fault makes wrong, as wrong_pixels() counts them.
int pixels_wrong_by(measure::Device& device, std::string_view technique,
                    const scene::ParticleScene& scene, ParticleFault fault) {
  const reference::SphereTruth truth = reference::render_spheres(scene, bounds, 1);
  return wrong_pixels(draw_image(device, particle_work(technique, scene, {.fault = fault})), truth);
}

TEST(VulkanParticles, InjectedFaultsChangeTheImage) {
  for_each_device([](measure::Device& device) {
    scene::ParticleScene small = generated("uniform", 30);
    small.width = 300;
    small.height = 220;
    const scene::ParticleScene ties = generated("coincident", 200, "random:3");
    const scene::ParticleScene dense = generated("uniform", 20000, "path_z:5/10");
    for (const std::string_view technique : techniques) {
      EXPECT_GT(pixels_wrong_by(device, technique, small, ParticleFault::small_sprite), 0)
          << technique;
      EXPECT_GT(pixels_wrong_by(device, technique, ties, ParticleFault::unresolved_ties), 0)
          << technique;
      EXPECT_GT(pixels_wrong_by(device, technique, dense, ParticleFault::reversed_depth), 0)
          << technique;
    }
    for (const ParticleFault fault : {ParticleFault::wrong_sense, ParticleFault::lost_at_border}) {
      EXPECT_GT(pixels_wrong_by(device, "tiles", dense, fault), 0) << static_cast<int>(fault);
    }
    const auto reason = device.unsupported(
        particle_work("tiles", dense, {.fault = ParticleFault::missing_barrier}));
    EXPECT_THAT(reason.value_or(""), testing::HasSubstr("work-group barriers"));
  });
}

TEST(VulkanParticles, WorkFromAnotherSuiteIsRejected) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = generated("uniform", 10);
    EXPECT_THAT(device.unsupported(particle_work("raycast", scene, {})).value_or(""),
                testing::HasSubstr("different suite"));
    EXPECT_THAT(device.unsupported(make_work("tiles", make_scene())).value_or(""),
                testing::HasSubstr("different suite"));
    EXPECT_THAT(
        device.unsupported(particle_work("polygon_tess", scene, {.corners = 1 << 20})).value_or(""),
        testing::HasSubstr("maxTessellationGenerationLevel"));
    scene::ParticleScene huge = scene;
    huge.width = 1 << 20;
    for (const std::string_view technique : techniques) {
      EXPECT_TRUE(device.unsupported(particle_work(technique, huge, {})).has_value()) << technique;
    }
  });
}

}  // namespace
}  // namespace triptych::vulkan_backend
