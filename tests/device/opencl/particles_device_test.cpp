// Tests of spheres that apply only to OpenCL. The contract tests check the images of every
// technique in every backend.
#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "tests/device/opencl/opencl_particles.hpp"

namespace triptych::opencl_backend {
namespace {

using measure::Purpose;
using technique::Culling;
using technique::ParticleFault;
using technique::ParticleOptions;

// Large particles are sorted into coarse tiles, and small particles into fine tiles. The scene has
// one particle that fills the view, some that overlap many tiles, and many that cover a few pixels.
// The image ends within a coarse tile.
scene::ParticleScene small_and_large() {
  Spheres spheres{{0, 0, -30, 12}, {2, 1, -9, 1.5}, {-3, -2, -8, 2}, {0.2, 0.1, -2, 0.3}};
  for (int i = 0; i < 600; ++i) {
    const double turn = 0.37 * i;
    const double away = 4 + 0.02 * i;
    spheres.push_back(
        {0.4 * away * std::cos(turn), 0.4 * away * std::sin(turn), -away, 0.04 + 0.0003 * i});
  }
  return seen_from(spheres, {0, 0, 0}, 70, 301, 211);
}

TEST(OpenClParticles, SmallAndLargeParticlesMixCorrectly) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = small_and_large();
    const core::Image first = draw_image(device, make_work("tiles", scene));
    EXPECT_EQ(wrong_pixels(first, truth_of(scene)), 0);
    for (const std::string_view technique : particle_techniques) {
      EXPECT_EQ(draw_image(device, make_work(technique, scene)), first) << technique;
    }
  });
}

// By the fill rule, a rectangle that equals the viewport covers each of its pixels exactly once,
// and a smaller rectangle covers the pixels whose centres are inside.
TEST(OpenClParticles, SpritesFollowTheFillRule) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene around = seen_from({{0, 0, 0, 1}}, {0.2, 0.1, 0.3}, 60);
    for (const std::string_view technique : particle_techniques) {
      EXPECT_EQ(counters(device, make_work(technique, around)).at("fragments"), 97U * 83U)
          << technique;
    }
    // On the axis, the edge of the silhouette of a sphere with radius r at the distance d is at tan
    // α, where sin α = r/d. Pixels are 2·tan(fov/2)/83 wide, because the image has 83 rows.
    const scene::ParticleScene one = seen_from({{0, 0, -4, 1}}, {0, 0, 0}, 60);
    const double edge = std::tan(std::asin(0.25)) * 83 / (2 * std::tan(std::acos(-1.0) / 6));
    // The number is odd, because the centre of one pixel is on the axis.
    const double pixels = 2 * std::floor(edge + 1.0 / 64) + 1;
    const auto counts = counters(device, make_work("quad_screen", one));
    EXPECT_EQ(static_cast<double>(counts.at("fragments")), pixels * pixels);
    EXPECT_EQ(counts.at("vertices"), 4U);
    EXPECT_EQ(counts.at("sprites"), 1U);
    EXPECT_EQ(counts.at("visible_ids"), 1U);
    // The area of an n-gon around a disc is n·tan(π/n)/π times the area of the disc. Here, the
    // disc has the sphere's radius 1 and lies at the distance 3·(1 − 1/1024), just in front of the
    // sphere. At this distance, the cone of all rays that touch the sphere has the radius
    // `silhouette`. Fragments outside of the cone are not kept.
    const double silhouette = 3 * (1 - 1.0 / 1024) * std::tan(std::asin(0.25));
    double before = std::numeric_limits<double>::infinity();
    for (const int corners : {4, 5, 8, 16, 32}) {
      const auto polygon = counters(device, make_work("polygon_tess", one, {.corners = corners}));
      const double pi = std::acos(-1.0);
      const auto fragments = static_cast<double>(polygon.at("fragments"));
      EXPECT_NEAR(fragments / static_cast<double>(polygon.at("fragments_kept")),
                  corners * std::tan(pi / corners) / (pi * silhouette * silhouette), 0.1)
          << corners;
      EXPECT_LT(fragments, before) << corners;
      EXPECT_EQ(polygon.at("vertices"), static_cast<std::uint64_t>(corners));
      before = fragments;
    }
  });
}

TEST(OpenClParticles, OcclusionCullsCellsAndIsBitIdentical) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = generated("uniform", 60000, "orbit_y:1/8", 128);
    for (const std::string_view technique : {"tiles", "polygon_adaptive"}) {
      const core::Image plain = draw_image(device, make_work(technique, scene));
      const auto prepared =
          device.prepare(make_work(technique, scene, {.culling = Culling::occlusion}));
      for (int frame = 0; frame < 3; ++frame) {
        static_cast<void>(prepared->frame(Purpose::timing));
        EXPECT_EQ(prepared->image(), plain) << technique << " frame " << frame;
      }
      const record::Counts counts = prepared->frame(Purpose::counters).counts;
      EXPECT_EQ(prepared->image(), plain);
      EXPECT_GT(counts.at("cells_culled"), 0U);
      EXPECT_LT(counts.at("particles_submitted"), 60000U);
      // The counts do not depend on what was drawn before.
      EXPECT_EQ(counters(device, make_work(technique, scene, {.culling = Culling::occlusion})),
                counts);
    }
  });
}

TEST(OpenClParticles, CountingAndExtraWorkLeaveTheImageUnchanged) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = generated("uniform", 60000, "orbit_y:1/8", 200);
    for (const std::string_view technique : {"tiles", "quad_instanced"}) {
      const auto plain = device.prepare(make_work(technique, scene));
      const auto slowed = device.prepare(make_work(technique, scene, {.extra_work_stride = 1}));
      static_cast<void>(plain->frame(Purpose::timing));
      static_cast<void>(slowed->frame(Purpose::timing));
      EXPECT_EQ(slowed->image(), plain->image());
      EXPECT_EQ(slowed->kernel_hash(), plain->kernel_hash());
      const core::Image timed = plain->image();
      EXPECT_TRUE(plain->frame(Purpose::statistics).counts.empty());
      EXPECT_FALSE(plain->frame(Purpose::counters).device_ns);
      EXPECT_EQ(plain->image(), timed);
    }
  });
}

// Returns a dense cluster in the middle, and a second one at 93 to 99 % of the distance to the edge
// of the screen. No cell (a range of neighbouring particles) contains particles of both clusters.
scene::ParticleScene at_the_edge() {
  Spheres spheres;
  for (int i = 0; i < 2000; ++i) {
    const double turn = 0.37 * i;
    const double away = 0.1 * std::sqrt(i % 500 / 500.0);
    const double x = i % 4 == 0 ? 0.96 * 10 * std::tan(std::acos(-1.0) / 6) : 0;
    spheres.push_back({x + away * std::cos(turn), away * std::sin(turn), -10, 0.03});
  }
  return seen_from(spheres, {0, 0, 0}, 60, 97, 97);
}

struct Injected {
  ParticleFault fault;
  std::string_view technique;
  bool conservative_depth = false;
};

// Each fault must change the image.
TEST(OpenClParticles, InjectedFaultsChangeTheImage) {
  const std::vector<scene::ParticleScene> scenes{generated("coincident", 4000, "path_z:7/8"),
                                                 generated("uniform", 60000, "random:5"),
                                                 at_the_edge(), small_and_large()};
  std::vector<reference::SphereTruth> truths;
  for (const scene::ParticleScene& scene : scenes) truths.push_back(truth_of(scene));
  for_each_device([&](measure::Device& device) {
    for (const Injected& each :
         std::initializer_list<Injected>{{ParticleFault::none, "tiles"},
                                         {ParticleFault::small_sprite, "tiles"},
                                         {ParticleFault::small_sprite, "quad_screen"},
                                         {ParticleFault::unresolved_ties, "tiles"},
                                         {ParticleFault::reversed_depth, "tiles"},
                                         {ParticleFault::wrong_sense, "tiles"},
                                         {ParticleFault::wrong_sense, "quad_screen", true},
                                         {ParticleFault::culled_visible, "tiles"},
                                         {ParticleFault::lost_at_border, "tiles"},
                                         {ParticleFault::missing_barrier, "tiles"}}) {
      SCOPED_TRACE(static_cast<int>(each.fault));
      SCOPED_TRACE(each.technique);
      const ParticleOptions options{.conservative_depth = each.conservative_depth,
                                    .fault = each.fault};
      int wrong = 0;
      for (std::size_t i = 0; i < scenes.size(); ++i) {
        const measure::Work work = make_work(each.technique, scenes[i], options);
        ASSERT_EQ(device.unsupported(work), std::nullopt);
        wrong += wrong_pixels(draw_image(device, work), truths[i]);
      }
      EXPECT_EQ(wrong > 0, each.fault != ParticleFault::none) << wrong;
    }
  });
}

TEST(OpenClParticles, UnsupportedWorkIsRejected) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = seen_from({{0, 0, -4, 1}}, {0, 0, 0}, 60);
    EXPECT_EQ(device.unsupported(make_work("tiles", scene)), std::nullopt);
    for (const char* technique : {"point", "quad_ray", "quad_tess", "bvh"}) {
      EXPECT_EQ(device.unsupported(make_work(technique, scene)), std::nullopt) << technique;
    }
    for (const char* technique : {"ray_query", "ray_pipeline", "mesh"}) {
      EXPECT_TRUE(device.unsupported(make_work(technique, scene))) << technique;
    }
    EXPECT_TRUE(device.unsupported(make_work("raycast", scene)));
    EXPECT_TRUE(device.unsupported(make_work("tiles", make_scene({}))));
    EXPECT_TRUE(device.unsupported(
        make_work("quad_instanced", scene, {.fault = ParticleFault::wrong_sense})));
    EXPECT_TRUE(
        device.unsupported(make_work("tiles", scene, {.ray = technique::ComputedAt::vertex})));
    EXPECT_EQ(device.unsupported(
                  make_work("quad_instanced", scene, {.fault = ParticleFault::lost_at_border})),
              std::nullopt);
    scene::ParticleScene wide = scene;
    wide.width = 40000;
    const measure::Work work = make_work("tiles", wide);
    ASSERT_TRUE(device.unsupported(work));
    EXPECT_NE(device.unsupported(work)->find("40000x83"), std::string::npos);
    EXPECT_THROW(static_cast<void>(device.prepare(work)), core::NotSupported);
  });
}

TEST(OpenClParticles, NoParticlesGiveTheBackground) {
  for_each_device([](measure::Device& device) {
    for (const Spheres& spheres : {Spheres{}, Spheres{{0, 0, 5, 1}}}) {
      for (const Culling culling : {Culling::none, Culling::frustum, Culling::occlusion}) {
        const scene::ParticleScene scene = seen_from(spheres, {0, 0, 0}, 60, 33, 17);
        const core::Image image =
            draw_image(device, make_work("tiles", scene, {.culling = culling}));
        EXPECT_EQ(image.pixel(32, 16), scene.background);
        EXPECT_EQ(std::ranges::count(image.ids, core::Image::no_particle), 33 * 17);
        EXPECT_EQ(std::ranges::count(image.depth, std::numeric_limits<float>::infinity()), 33 * 17);
      }
    }
  });
}

}  // namespace
}  // namespace triptych::opencl_backend
