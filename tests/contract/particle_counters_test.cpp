// The counters are consistent with each other and show what the paper found.

#include <algorithm>

#include "particle_scenes.hpp"

namespace triptych::contract {
namespace {

using technique::Culling;

record::Counts counted(measure::Device& device, const measure::Work& work) {
  const auto prepared = device.prepare(work);
  static_cast<void>(prepared->frame(measure::Purpose::timing));
  return prepared->frame(measure::Purpose::counters).counts;
}

std::uint64_t visible_ids(const core::Image& image) {
  std::set<std::uint32_t> ids(image.ids.begin(), image.ids.end());
  ids.erase(core::Image::no_particle);
  return ids.size();
}

TEST(ParticleCounters, AddUp) {
  on_every_device([](measure::Device& device) {
    for (const Culling culling : {Culling::none, Culling::frustum}) {
      SCOPED_TRACE(technique::name_of(culling));
      ParticleWork work = generated_work("uniform", 20000, "path_z:7/8", 64);
      work.options.culling = culling;
      const std::uint64_t visible = visible_ids(truth_of(work).image());
      with_every_technique(device, work, [&](const measure::Work& whole) {
        const record::Counts counts = counted(device, whole);
        EXPECT_NEAR(static_cast<double>(counts.at("visible_ids")), static_cast<double>(visible),
                    0.01 * static_cast<double>(visible) + 2);
        // Techniques with rays leave no cells out.
        if (!counts.contains("particles_submitted")) return;
        EXPECT_EQ(counts.at("particles_submitted") + counts.at("particles_culled"), 20000U);
        EXPECT_EQ(counts.at("particles_culled") > 0, culling == Culling::frustum);
        EXPECT_EQ(counts.at("cells_culled") > 0, culling == Culling::frustum);
        EXPECT_LE(counts.at("sprites"), counts.at("particles_submitted"));
        if (counts.contains("fragments")) {
          EXPECT_EQ(counts.at("fragments"),
                    counts.at("fragments_kept") + counts.at("fragments_discarded"));
          EXPECT_GT(counts.at("fragments_kept"), 0U);
        }
      });
    }
  });
}

// Sprites of every shape cover the disc of a sphere, so that all keep the same fragments; a polygon
// with more corners wastes fewer (S6). Tiles take no fragment that is behind.
TEST(ParticleCounters, SpritesOfEveryShapeKeepTheSameFragments) {
  on_every_device([](measure::Device& device) {
    ParticleWork work = generated_work("uniform", 100, "orbit_y:1/8", 256);
    work.scene.radius_scale = 2;  // large enough for more than four corners
    work.options.corners = 8;
    std::map<std::string, record::Counts> counts;
    with_every_technique(device, work, [&](const measure::Work& whole) {
      counts[whole.technique] = counted(device, whole);
    });
    std::optional<std::uint64_t> kept;
    for (const auto& [technique, each] : counts) {
      if (!each.contains("fragments_kept")) continue;
      if (!kept) kept = each.at("fragments_kept");
      if (technique == "tiles") {
        EXPECT_LE(each.at("fragments_kept"), *kept);
      } else {
        EXPECT_EQ(each.at("fragments_kept"), *kept) << technique;
      }
    }
    if (!counts.contains("polygon_tess")) return;
    const std::uint64_t square = counts["quad_instanced"]["fragments"];
    EXPECT_LT(counts["polygon_tess"]["fragments"], square);
    EXPECT_LT(counts["polygon_adaptive"]["fragments"], square);
  });
}

// With twenty times as many spheres, most of which are hidden, only a few times as many nodes are
// visited. Each node tests two boxes.
TEST(ParticleCounters, RaysVisitOnlyWhatTheyMayHit) {
  on_every_device([](measure::Device& device) {
    const auto nodes = [&](std::uint64_t particles) -> double {
      const measure::Work whole{
          .technique = "bvh", .scene = generated_work("hidden", particles, "orbit_y:0/8", 64)};
      if (device.unsupported(whole)) return 0;
      const record::Counts counts = counted(device, whole);
      EXPECT_GE(counts.at("boxes_tested"), 2 * counts.at("nodes_visited"));
      EXPECT_GT(counts.at("intersections_tested"), 0U);
      return static_cast<double>(counts.at("nodes_visited"));
    };
    const double few = nodes(2000);
    EXPECT_LE(nodes(40000), 10 * few);
  });
}

std::uint64_t fragments_of(measure::Device& device, std::string technique, ParticleWork work) {
  work.options.culling = Culling::none;  // as in the paper
  const measure::Work whole{.technique = std::move(technique), .scene = std::move(work)};
  return device.unsupported(whole) ? 0 : counted(device, whole).at("fragments");
}

// The finding of the paper (section 6.3): from outside, both kinds of quads have the same
// fragments. With the camera among the spheres, the screen-aligned quad has ten times as many,
// because spheres that reach the plane of the eye have no bounded projection.
TEST(ParticleCounters, ScreenAlignedQuadsAreCostlyAmongTheSpheres) {
  on_every_device([](measure::Device& device) {
    const auto ratio = [&](const char* camera) {
      const ParticleWork work = generated_work("uniform", 3000, camera, 96);
      const double ray = static_cast<double>(fragments_of(device, "quad_instanced", work));
      return static_cast<double>(fragments_of(device, "quad_screen", work)) / ray;
    };
    if (fragments_of(device, "quad_screen", generated_work("uniform", 10, "orbit_y:1/8", 8)) == 0) {
      return;  // no geometry shaders
    }
    EXPECT_NEAR(ratio("orbit_y:1/8"), 1, 0.1);
    EXPECT_GT(ratio("path_z:8/10"), 10);
  });
}

}  // namespace
}  // namespace triptych::contract
