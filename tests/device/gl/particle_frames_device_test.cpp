// Tests the counts and times of particle frames, and which frames are rejected.
#include <gmock/gmock.h>

#include <algorithm>

#include "core/error.hpp"
#include "technique/particles/tile_rounds.hpp"
#include "tests/device/gl/gl_particles.hpp"

namespace triptych::gl_backend {
namespace {

using measure::Purpose;
using technique::ComputedAt;
using technique::Culling;
using technique::ParticleFault;
using technique::ParticleOptions;
using testing::AllOf;
using testing::Contains;
using testing::Ge;
using testing::HasSubstr;
using testing::Key;
using testing::Not;
using testing::Pair;

std::uint64_t covered(const core::Image& image) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(image.ids, [](auto id) { return id != core::Image::no_particle; }));
}

// Returns the number of corners of one sphere's sprite.
std::uint64_t corners_of(std::string_view technique) {
  if (technique == "point") return 1;
  if (technique == "polygon_tess") return 8;
  // The adaptive polygon chooses its number of corners from the radius R in pixels, as the cube
  // root of 0.323·R². In the test below, the radius is 14 pixels and this number is 3.98, which is
  // rounded to 4.
  return 4;
}

TEST(GlParticleFrames, ASingleSphereIsCountedCorrectly) {
  for_each_device([](measure::Device& device) {
    // The camera is so far away that a ray-aligned sprite is hardly larger than the silhouette.
    const scene::ParticleScene scene = seen_from({{0, 0, -60, 3}}, {0, 0, 0}, 7.5);
    for_each_technique(device, [&](std::string_view technique) {
      const auto prepared = device.prepare(particle_work(technique, scene, {.corners = 8}));
      const record::Counts counts = prepared->frame(Purpose::counters).counts;
      const std::uint64_t kept = covered(prepared->image());
      EXPECT_GT(kept, 500U);
      EXPECT_THAT(counts,
                  AllOf(Contains(Pair("cells", 1)), Contains(Pair("cells_culled", 0)),
                        Contains(Pair("particles_submitted", 1)),
                        Contains(Pair("particles_culled", 0)), Contains(Pair("visible_ids", 1))));
      if (technique == "tiles") return;
      EXPECT_THAT(counts,
                  AllOf(Contains(Pair("sprites", 1)), Contains(Pair("fragments_kept", kept)),
                        Contains(Pair("vertices", corners_of(technique)))));
      EXPECT_EQ(counts.at("fragments"),
                counts.at("fragments_kept") + counts.at("fragments_discarded"));
      // A square around a disc of k pixels has 4/π·k pixels, and an octagon has 1.05·k.
      const double share = static_cast<double>(counts.at("fragments")) / static_cast<double>(kept);
      EXPECT_NEAR(share, technique == "polygon_tess" ? 1.05 : 1.27, 0.15);
    });
  });
}

TEST(GlParticleFrames, CulledParticlesAreCounted) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene =
        generated("generate:uniform:20000", scene::ColourKind::rgba8, "path_z:7/8");
    for_each_technique(device, [&](std::string_view technique) {
      const auto prepared = device.prepare(particle_work(technique, scene));
      const record::Counts counts = prepared->frame(Purpose::counters).counts;
      EXPECT_EQ(counts.at("particles_submitted") + counts.at("particles_culled"), 20000U);
      EXPECT_GT(counts.at("particles_culled"), 1000U);
      EXPECT_GT(counts.at("cells_culled"), 2U);
      EXPECT_LT(counts.at("cells_culled"), counts.at("cells"));
      const auto all = device.prepare(particle_work(technique, scene, {.culling = Culling::none}));
      const record::Counts uncut = all->frame(Purpose::counters).counts;
      EXPECT_EQ(uncut.at("particles_submitted"), 20000U);
      EXPECT_EQ(uncut.at("cells_culled"), 0U);
      EXPECT_EQ(uncut.at("visible_ids"), counts.at("visible_ids"));
      if (technique != "tiles") {
        EXPECT_EQ(uncut.at("fragments_kept"), counts.at("fragments_kept"));
      }
    });
  });
}

TEST(GlParticleFrames, EveryPurposeDrawsTheSameImage) {
  for_each_device([](measure::Device& device) {
    for_each_technique(device, [&](std::string_view technique) {
      const auto prepared =
          device.prepare(particle_work(technique, generated("generate:uniform:900")));
      const measure::Frame timed = prepared->frame(Purpose::timing);
      EXPECT_GT(timed.wall_ns, 0);
      EXPECT_TRUE(timed.counts.empty());
      const core::Image first = prepared->image();
      const measure::Frame statistics = prepared->frame(Purpose::statistics);
      EXPECT_FALSE(statistics.device_ns);
      EXPECT_EQ(prepared->image(), first);
      static_cast<void>(prepared->frame(Purpose::counters));
      EXPECT_EQ(prepared->image(), first);
      static_cast<void>(prepared->frame(Purpose::timing));
      EXPECT_EQ(prepared->image(), first);
    });
  });
}

TEST(GlParticleFrames, StatisticsCoverExactlyTheStagesInUse) {
  for_each_device([](measure::Device& device) {
    if (device.info().driver != "llvmpipe") return;
    const auto statistics = [&](std::string_view technique) {
      const auto prepared = device.prepare(
          particle_work(technique, generated("generate:uniform:300"), {.culling = Culling::none}));
      return prepared->frame(Purpose::statistics).counts;
    };
    const record::Counts quads = statistics("quad_ray");
    EXPECT_THAT(quads, AllOf(Contains(Pair("input_assembly_vertices", 300)),
                             Contains(Pair("geometry_primitives", 600)),
                             Contains(Key("fragment_invocations")),
                             Not(Contains(Key("tessellation_control_patches"))),
                             Not(Contains(Key("compute_invocations")))));
    const record::Counts patches = statistics("quad_tess");
    EXPECT_THAT(patches, AllOf(Contains(Pair("tessellation_control_patches", 300)),
                               Not(Contains(Key("geometry_primitives")))));
    const auto culled =
        device.prepare(particle_work("quad_instanced", generated("generate:uniform:300")));
    EXPECT_THAT(culled->frame(Purpose::statistics).counts,
                Contains(Pair("compute_invocations", Ge(1))));
  });
}

// Returns large spheres in front of small ones, in separate cells. (Particles are sorted into
// cells, which are drawn and culled as a whole.)
scene::ParticleScene large_before_small() {
  std::vector<std::array<double, 4>> spheres;
  for (int i = 0; i < 400; ++i) spheres.push_back({0.01 * (i % 20), 0.01 * (i / 20.0), -4, 1});
  for (int i = 0; i < 20000; ++i) {
    spheres.push_back({0.2 * (i % 200) - 20, 0.2 * (i / 200) - 10.0, -60, 0.1});
  }
  return seen_from(spheres, {0, 0, 0}, 60);
}

// Returns the number of work groups of 64 invocations that a frame has in addition to those that
// resolve (draw) tiles. Each line of the sum names its passes, which tiles.glsl describes.
std::uint64_t groups_of_other_passes(const scene::ParticleScene& scene,
                                     const technique::TileRounds& rounds) {
  constexpr std::uint64_t group = 64;
  // The number of work groups among which all particles are distributed.
  const std::uint64_t spread =
      std::min<std::uint64_t>(256, (scene.particles->count() + group - 1) / group);
  std::uint64_t groups = rounds.small ? spread : 0;  // index
  for (const technique::TileRound& round : rounds.rounds) {
    const bool last = &round == &rounds.rounds.back();
    groups += (round.cells + group - 1) / group + round.cells;  // cells, bin
    if (!last || round.entries > 0) groups += 1;                // place: a group per 64 tiles
    if (!last) groups += 1;                                     // settle
    if (round.entries > 0) groups += spread;                    // fill
  }
  return groups;
}

std::uint64_t invocations(measure::Device& device, const scene::ParticleScene& scene) {
  return device.prepare(particle_work("tiles", scene))
      ->frame(Purpose::statistics)
      .counts.at("compute_invocations");
}

struct InOnePlace {
  double radius;
  std::size_t spheres;
  std::uint64_t tiles;  // the number of tiles that each sphere may overlap
  bool at_once;         // whether the last pass draws the large spheres
};

// Draws spheres in an image of 45×38 pixels, which has 9 tiles. There must be 32 invocations of the
// pass that resolves (draws) tiles for each tile that a sphere may overlap, and none for other
// tiles. Small spheres are drawn while they are sorted, and a few large spheres are drawn by the
// last pass.
TEST(GlParticleFrames, EmptyTilesAreNotResolved) {
  for_each_device([](measure::Device& device) {
    if (device.info().driver != "llvmpipe")
      return;  // only llvmpipe is known to count invocations exactly
    for (const auto& [radius, count, tiles, at_once] :
         {InOnePlace{1, 1, 0, true}, {8, 1, 4, true}, {8, 40, 4, false}, {40, 40, 9, false}}) {
      const scene::ParticleScene scene =
          seen_from(std::vector<std::array<double, 4>>(count, {-6, 0, -60, radius}), {0, 0, 0}, 30);
      const technique::TileRounds rounds =
          technique::tile_rounds(scene, technique::arrange(scene), 65535, 1U << 24U);
      ASSERT_EQ(rounds.rounds.size(), 1U);
      EXPECT_EQ(rounds.at_once, at_once);
      const record::Counts counts =
          device.prepare(particle_work("tiles", scene))->frame(Purpose::counters).counts;
      EXPECT_EQ(counts.at("bin_entries"), count * tiles);
      EXPECT_EQ(invocations(device, scene),
                64 * groups_of_other_passes(scene, rounds) + (at_once ? 0 : 32 * tiles));
    }
  });
}

// A frame processes its cells in several rounds. If large spheres come before small ones, no round
// resolves more than all 9 tiles, and the last round resolves none.
TEST(GlParticleFrames, RoundsWithoutLargeSpheresAreNotFilled) {
  for_each_device([](measure::Device& device) {
    if (device.info().driver != "llvmpipe") return;
    const scene::ParticleScene scene = large_before_small();
    const technique::TileRounds rounds =
        technique::tile_rounds(scene, technique::arrange(scene), 65535, 1U << 24U);
    ASSERT_GT(rounds.rounds.size(), 1U);
    ASSERT_GT(rounds.rounds.front().entries, 0U);
    ASSERT_EQ(rounds.rounds.back().entries, 0U);
    const std::uint64_t all = invocations(device, scene);
    const std::uint64_t others = 64 * groups_of_other_passes(scene, rounds);
    EXPECT_GT(all, others);
    EXPECT_LE(all, others + 32 * 9 * (rounds.rounds.size() - 1));
  });
}

// Returns two clusters of one cell each: one in the middle of the image, and one at its right edge.
scene::ParticleScene one_cell_at_the_edge() {
  std::vector<std::array<double, 4>> spheres;
  for (int i = 0; i < 1200; ++i) {
    const double offset = 0.0002 * (i / 2);
    spheres.push_back({i % 2 == 0 ? -5.0 : 5.45, offset, -20 + offset, 0.3});
  }
  return seen_from(spheres, {-5, 0, 0}, 47.9);
}

TEST(GlParticleFrames, InjectedFaultsChangeTheImage) {
  for_each_device([](measure::Device& device) {
    for_each_technique(device, [&](std::string_view technique) {
      const auto draw = [&](const scene::ParticleScene& scene, ParticleFault fault) {
        return draw_image(device, particle_work(technique, scene, {.fault = fault})).ids;
      };
      const auto changes = [&](const scene::ParticleScene& scene, ParticleFault fault) {
        return draw(scene, fault) != draw(scene, ParticleFault::none);
      };
      EXPECT_TRUE(changes(generated("generate:coincident:80"), ParticleFault::unresolved_ties));
      EXPECT_TRUE(changes(generated("generate:uniform:300"), ParticleFault::reversed_depth));
      EXPECT_TRUE(changes(one_cell_at_the_edge(), ParticleFault::culled_visible));
      scene::ParticleScene large = seen_from({{0, 0, -3, 1}}, {0, 0, 0}, 60);
      large.width = large.height = 400;
      if (technique != "tiles" && technique != "polygon_tess") {
        EXPECT_TRUE(changes(large, ParticleFault::small_sprite));
      }
    });
  });
}

TEST(GlParticleFrames, ReversedDepthLeavesTheBackground) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = generated("generate:uniform:300");
    for_each_technique(device, [&](std::string_view technique) {
      const core::Image right = draw_image(device, particle_work(technique, scene));
      const core::Image wrong = draw_image(
          device, particle_work(technique, scene, {.fault = ParticleFault::reversed_depth}));
      for (std::size_t i = 0; i < right.ids.size(); ++i) {
        const bool empty = right.ids[i] == core::Image::no_particle;
        ASSERT_EQ(wrong.ids[i] == core::Image::no_particle, empty);
        ASSERT_EQ(std::isinf(wrong.depth[i]), empty);
        ASSERT_GE(wrong.depth[i], right.depth[i]);
      }
    });
  });
}

TEST(GlParticleFrames, UnsupportedOptionsAreRejectedWithAReason) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = seen_from({{0, 0, -3, 1}}, {0, 0, 0}, 60);
    const auto reason = [&](std::string_view technique, const ParticleOptions& options) {
      return device.unsupported(particle_work(technique, scene, options)).value_or("");
    };
    EXPECT_THAT(reason("quad_ray", {.fault = ParticleFault::lost_at_border}), HasSubstr("tiles"));
    EXPECT_THAT(reason("quad_ray", {.fault = ParticleFault::missing_barrier}),
                HasSubstr("work-group barriers"));
    EXPECT_THAT(reason("quad_ray", {.fault = ParticleFault::wrong_sense}),
                HasSubstr("conservative_depth=on"));
    EXPECT_THAT(
        reason("quad_ray", {.culling = Culling::none, .fault = ParticleFault::culled_visible}),
        HasSubstr("culling"));
    EXPECT_THAT(reason("point", {.ray = ComputedAt::vertex}), HasSubstr("ray=pixel"));
    EXPECT_THAT(reason("raycast", {}), HasSubstr("volumes"));
    EXPECT_THAT(device.unsupported(make_work("quad_ray", make_scene({}))).value_or(""),
                HasSubstr("particles"));
    EXPECT_THROW(static_cast<void>(device.prepare(
                     particle_work("quad_ray", scene, {.fault = ParticleFault::wrong_sense}))),
                 core::NotSupported);
    scene::ParticleScene wide = scene;
    wide.width = 100000;
    EXPECT_THAT(device.unsupported(particle_work("quad_ray", wide)).value_or(""),
                AllOf(HasSubstr("100000"), HasSubstr("GL_MAX_RENDERBUFFER_SIZE")));
  });
}

TEST(GlParticleFrames, ConservativeDepthIsASeparateBuild) {
  for_each_device([](measure::Device& device) {
    const scene::ParticleScene scene = seen_from({{0, 0, -3, 1}}, {0, 0, 0}, 60);
    for_each_technique(device, [&](std::string_view technique) {
      if (technique == "tiles") return;  // `tiles` ignores the option, so it has only one build
      const auto hash = [&](const ParticleOptions& options) {
        return device.prepare(particle_work(technique, scene, options))->kernel_hash();
      };
      const std::string plain = hash({});
      EXPECT_EQ(hash({}), plain);
      const std::string conservative = hash({.conservative_depth = true});
      EXPECT_NE(conservative, plain);
      EXPECT_NE(hash({.conservative_depth = true, .fault = ParticleFault::wrong_sense}),
                conservative);
    });
  });
}

}  // namespace
}  // namespace triptych::gl_backend
