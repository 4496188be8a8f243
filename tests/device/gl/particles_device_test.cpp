// Compares images of spheres with the reference image within the suite's bound, and with each
// other.
#include <fmt/format.h>

#include <limits>

#include "reference/spheres.hpp"
#include "suites/particles/tolerance.hpp"
#include "tests/device/gl/gl_particles.hpp"

namespace triptych::gl_backend {
namespace {

using scene::ColourKind;
using technique::ComputedAt;
using technique::Culling;
using technique::ParticleFault;
using technique::ParticleOptions;

// The numbers of pixels that differ from the reference image.
struct Wrong {
  int ids = 0;
  int depths = 0;
  int colours = 0;
  bool operator==(const Wrong&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Wrong& wrong) {
  return out << fmt::format("{} ids, {} depths, {} colours", wrong.ids, wrong.depths,
                            wrong.colours);
}

reference::SphereTruth truth_of(const scene::ParticleScene& scene,
                                ComputedAt ray = ComputedAt::pixel) {
  return reference::render_spheres(scene, particles_suite::error_model(scene, ray));
}

Wrong compared(const core::Image& image, const reference::SphereTruth& truth) {
  Wrong wrong;
  EXPECT_EQ(image.ids.size(), truth.ids.size());
  for (std::size_t i = 0; i < truth.ids.size(); ++i) {
    for (std::size_t c = 4 * i; c < 4 * i + 4; ++c) {
      const double error = std::abs(static_cast<double>(image.rgba[c]) - truth.rgba[c]);
      if (!(error <= truth.bound[i])) {
        ++wrong.colours;
        break;
      }
    }
    if (truth.certain[i] == 0) continue;
    if (image.ids[i] != truth.ids[i]) ++wrong.ids;
    const double depth = static_cast<double>(image.depth[i]);
    const bool same_depth =
        depth == truth.depth[i] || std::abs(depth - truth.depth[i]) <= truth.depth_bound[i];
    if (!same_depth) ++wrong.depths;
  }
  return wrong;
}

TEST(GlParticles, EveryTechniqueStaysWithinTheBound) {
  for_each_device([](measure::Device& device) {
    for (const ColourKind colour : {ColourKind::rgba8, ColourKind::rgba32, ColourKind::intensity}) {
      const scene::ParticleScene scene = generated("generate:uniform:700", colour);
      const reference::SphereTruth truth = truth_of(scene);
      for_each_technique(device, [&](std::string_view technique) {
        for (const ComputedAt transfer : {ComputedAt::vertex, ComputedAt::pixel}) {
          EXPECT_EQ(
              compared(draw_image(device, particle_work(technique, scene, {.transfer = transfer})),
                       truth),
              Wrong{})
              << scene::name_of(colour);
        }
      });
    }
  });
}

TEST(GlParticles, AwkwardCamerasLoseNoPixel) {
  const glm::dvec3 origin{0, 0, 0};
  const std::vector<std::array<double, 4>> unit{{0, 0, 0, 1}};
  std::vector<std::pair<std::string, scene::ParticleScene>> cases;
  for (const double distance : {1.0001, 1.25, 2.0, 1e5}) {
    const double fills = 2.2 * std::asin(1 / distance) * 57.3;
    for (const double fov : {60.0, std::min(fills, 150.0), 150.0}) {
      cases.emplace_back(fmt::format("{} radii, {} degrees", distance, fov),
                         seen_from(unit, {0, 0, distance}, fov));
    }
  }
  cases.emplace_back("inside", seen_from(unit, {0.3, 0.2, 0.1}, 60));
  cases.emplace_back("inside, in the middle", seen_from(unit, origin, 150));
  cases.emplace_back("across the eye plane",
                     seen_from({{2, 0, 0, 1.5}, {0, 3, 0.2, 2.9}}, origin, 120));
  cases.emplace_back("behind with a part in front",
                     seen_from({{0.8, 0, 0.6, 0.9}, {-3, 0, 1, 2}}, origin, 140));
  cases.emplace_back("behind", seen_from({{0, 0, 3, 1}, {1, 0, 2, 0.5}}, origin, 60));
  cases.emplace_back(
      "at the edge",
      seen_from({{1.37, 0, -2, 0.3}, {0, -1.2, -2, 0.3}, {-1.7, 1.4, -2, 0.5}}, origin, 60));
  cases.emplace_back("interpenetrating",
                     seen_from({{0, 0, -3, 1}, {0.7, 0.1, -3.2, 1}}, origin, 60));
  cases.emplace_back("less than a pixel", seen_from({{0.01, 0.02, -3, 0.001}}, origin, 60));
  cases.emplace_back("ten thousand times the neighbour",
                     seen_from({{0, 0, -10001.5, 1e4}, {0, 0.2, -1.2, 1}}, origin, 60));
  for_each_device([&](measure::Device& device) {
    for (const auto& [name, scene] : cases) {
      const reference::SphereTruth truth = truth_of(scene);
      for_each_technique(device, [&, &what = name, &shown = scene](std::string_view technique) {
        EXPECT_EQ(compared(draw_image(device, particle_work(technique, shown)), truth), Wrong{})
            << what;
      });
    }
  });
}

// Some of the spheres are larger than the points of any known device, and they are in front of
// smaller ones.
TEST(GlParticles, SpheresLargerThanPointsAreDrawn) {
  scene::ParticleScene scene =
      seen_from({{0, 0, -3, 1.6}, {1.5, 0.2, -2, 0.2}, {-1.4, -1.2, -2.5, 0.3}}, {0, 0, 0}, 70);
  scene.width = 320;
  scene.height = 300;
  const reference::SphereTruth truth = truth_of(scene);
  for_each_device([&](measure::Device& device) {
    for_each_technique(device, [&](std::string_view technique) {
      EXPECT_EQ(compared(draw_image(device, particle_work(technique, scene)), truth), Wrong{});
    });
  });
}

// Draws a sphere that intersects the plane of the eye and is visible only in the right part of the
// image. The sprite that the technique `point` draws must be only as large as the visible part of
// the sphere, regardless of whether the device supports points of that size.
TEST(GlParticles, APointAcrossTheEyePlaneDoesNotFillTheViewport) {
  for_each_device([](measure::Device& device) {
    scene::ParticleScene scene = seen_from({{1.5, 0, -0.9, 1}}, {0, 0, 0}, 60);
    scene.width = 600;
    scene.height = 400;
    const measure::Work work = particle_work("point", scene);
    if (device.unsupported(work)) return;
    const record::Counts counts = device.prepare(work)->frame(measure::Purpose::counters).counts;
    EXPECT_EQ(counts.at("sprites"), 1U);
    EXPECT_GT(counts.at("fragments_kept"), 1000U);
    EXPECT_LE(counts.at("fragments"), 400U * 402U);
  });
}

TEST(GlParticles, RaysComputedAtVerticesStayWithinTheirBound) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = generated("generate:droplets:400");
    const reference::SphereTruth truth = truth_of(scene, ComputedAt::vertex);
    for_each_technique(device, [&](std::string_view technique) {
      const measure::Work work = particle_work(technique, scene, {.ray = ComputedAt::vertex});
      if (device.unsupported(work)) return;
      EXPECT_EQ(compared(draw_image(device, work), truth), Wrong{});
    });
  });
}

TEST(GlParticles, AllTechniquesAreBitIdentical) {
  for_each_device([](measure::Device& device) {
    for (const char* data : {"generate:uniform:3000", "generate:coincident:800"}) {
      const scene::ParticleScene scene = generated(data);
      const core::Image first = draw_image(device, particle_work("quad_screen", scene));
      for_each_technique(device, [&](std::string_view technique) {
        EXPECT_EQ(draw_image(device, particle_work(technique, scene)), first) << data;
      });
    }
  });
}

TEST(GlParticles, OptionsWithoutEffectOnTheImageAreBitIdentical) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene =
        generated("generate:plume:5000", ColourKind::rgba8, "path_y:3/4");
    for_each_technique(device, [&](std::string_view technique) {
      const core::Image plain =
          draw_image(device, particle_work(technique, scene, {.culling = Culling::none}));
      for (const ParticleOptions& options :
           {ParticleOptions{.culling = Culling::frustum},
            {.conservative_depth = true},
            {.corners = 7},
            {.corners = 32},
            {.culling = Culling::occlusion},
            {.extra_work_stride = 4},
            {.culling = Culling::occlusion, .extra_work_stride = 5},
            {.culling = Culling::none, .extra_work_stride = 3}}) {
        EXPECT_EQ(draw_image(device, particle_work(technique, scene, options)), plain);
      }
    });
  });
}

// A wall hides most particles. Cells must be culled, but the image must remain bit-identical.
TEST(GlParticles, CullingHiddenCellsIsBitIdentical) {
  for_each_device([](measure::Device& device) {
    scene::ParticleScene scene = generated("generate:uniform:30000");
    scene.radius_scale = 2.5;
    scene.width = scene.height = 128;
    const core::Image plain =
        draw_image(device, particle_work("quad_ray", scene, {.culling = Culling::none}));
    for_each_technique(device, [&](std::string_view technique) {
      const auto prepared =
          device.prepare(particle_work(technique, scene, {.culling = Culling::occlusion}));
      for (int i = 0; i < 3; ++i) {
        static_cast<void>(prepared->frame(measure::Purpose::timing));
        EXPECT_EQ(prepared->image(), plain) << i;
      }
      const record::Counts counts = prepared->frame(measure::Purpose::counters).counts;
      // softpipe's compute shaders do not see the results of earlier draws, so no cell counts as
      // hidden.
      if (device.info().driver != "softpipe") {
        EXPECT_GT(counts.at("cells_culled"), counts.at("cells") / 20);
      }
      EXPECT_EQ(prepared->frame(measure::Purpose::counters).counts, counts);
      EXPECT_EQ(prepared->image(), plain);
    });
  });
}

TEST(GlParticles, ScenesWithNoOrFewParticles) {
  for_each_device([](measure::Device& device) {
    for_each_technique(device, [&](std::string_view technique) {
      for (const std::vector<std::array<double, 4>>& spheres :
           {std::vector<std::array<double, 4>>{}, {{0, 0, 5, 1}}}) {
        const core::Image image =
            draw_image(device, particle_work(technique, seen_from(spheres, {0, 0, 0}, 60)));
        for (std::size_t i = 0; i < image.pixel_count(); ++i) {
          ASSERT_EQ(image.rgba[4 * i + 2], 0.3F);
          ASSERT_EQ(image.ids[i], core::Image::no_particle);
          ASSERT_EQ(image.depth[i], std::numeric_limits<float>::infinity());
        }
      }
      for (const int count : {1, 63, 64, 65}) {
        const scene::ParticleScene scene = generated(fmt::format("generate:uniform:{}", count));
        EXPECT_EQ(compared(draw_image(device, particle_work(technique, scene)), truth_of(scene)),
                  Wrong{})
            << count;
      }
    });
  });
}

}  // namespace
}  // namespace triptych::gl_backend
