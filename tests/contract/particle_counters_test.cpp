// Tests that the counters are consistent with each other and reproduce a result of the paper by
// Bruder et al. (docs/paper.md).

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
  on_every_driver([](measure::Device& device) {
    for (const Culling culling : {Culling::none, Culling::frustum}) {
      SCOPED_TRACE(technique::name_of(culling));
      ParticleWork work = generated_work("uniform", 20000, "path_z:7/8", 64);
      work.options.culling = culling;
      const std::uint64_t visible = visible_ids(truth_of(work).image());
      with_every_technique(device, work, [&](const measure::Work& whole) {
        const record::Counts counts = counted(device, whole);
        EXPECT_NEAR(static_cast<double>(counts.at("visible_ids")), static_cast<double>(visible),
                    0.01 * static_cast<double>(visible) + 2);
        // Techniques that trace rays cull no cells.
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

// Sprites of every shape cover the sphere's disc, so the same number of fragments is kept for every
// shape. A polygon with more corners wastes fewer fragments (S6 in
// reference/sphere_closed_forms.hpp). `tiles` processes no fragment behind a hit.
TEST(ParticleCounters, SpritesOfEveryShapeKeepTheSameFragments) {
  on_every_driver([](measure::Device& device) {
    ParticleWork work = generated_work("uniform", 100, "orbit_y:1/8", 256);
    work.scene.radius_scale = 2;  // large enough for polygons with more than four corners
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

// Returns a sphere that fills the image, and more spheres behind its surface, each of which alone
// would fill the image as well.
ParticleWork covered_crowd(int crowd) {
  std::vector<std::array<double, 4>> spheres{{0, 0, -20, 20}};
  core::Random random(7);
  for (int i = 0; i < crowd; ++i) {
    spheres.push_back(
        {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-12, -6), 3});
  }
  return particle_work(particles_of(spheres), camera_looking_at({0, 0, 5}, {0, 0, 0}, 10), 64, 64);
}

// Rays traverse the tree of boxes in beams (bundles) of at least 8 pixels. A beam must skip all
// boxes behind the surface that it has already found. Every sphere fills the image, so every beam
// intersects every box. Boxes that contain the large sphere begin at its front, at a distance of 5
// from the eye. All other boxes begin beyond 7.9. The surface of the large sphere is at most 5.1
// away in the whole image, so it hides all other boxes. In each level of the tree, a beam visits at
// most four nodes:
//   - one node on the way to the leaf of the large sphere, to which the beam descends first,
//     because it visits the nearer child of each node first;
//   - one node on the way to a second leaf. Only OpenCL's beams visit it, because they update their
//     farthest depth only after every eighth sphere, and a leaf has four spheres;
//   - the siblings of these two nodes. Their boxes may have been tested before the depth was known,
//     but nothing below them is visited.
TEST(ParticleCounters, RaysVisitOnlyWhatTheyMayHit) {
  constexpr std::uint64_t levels = 11;
  constexpr std::uint64_t most_beams = 64 * 64 / 8;
  constexpr std::uint64_t most_nodes = most_beams * 4 * levels;
  on_every_driver([&](measure::Device& device) {
    const auto counts_with = [&](technique::ParticleFault fault) {
      ParticleWork work = covered_crowd((4 << levels) - 1);
      work.options.fault = fault;
      const measure::Work whole{.technique = "bvh", .scene = std::move(work)};
      return device.unsupported(whole) ? record::Counts() : counted(device, whole);
    };
    const record::Counts counts = counts_with(technique::ParticleFault::none);
    if (counts.empty()) return;
    EXPECT_GE(counts.at("nodes_visited"), levels);
    EXPECT_LE(counts.at("nodes_visited"), most_nodes);
    EXPECT_GE(counts.at("boxes_tested"), 2 * counts.at("nodes_visited"));
    EXPECT_EQ(counts.at("visible_ids"), 1U);
    // With the fault that makes the farthest surface win, nothing is behind the surface that was
    // found, so all boxes are visited.
    const record::Counts faulty = counts_with(technique::ParticleFault::reversed_depth);
    if (faulty.empty()) return;
    EXPECT_GT(faulty.at("nodes_visited"), most_nodes);
  });
}

std::uint64_t fragments_of(measure::Device& device, std::string technique, ParticleWork work) {
  work.options.culling = Culling::none;  // as in the paper
  const measure::Work whole{.technique = std::move(technique), .scene = std::move(work)};
  return device.unsupported(whole) ? 0 : counted(device, whole).at("fragments");
}

// This is the paper's result (section 6.3). From outside, screen-aligned quads produce about as
// many fragments as ray-aligned quads. With the camera among the spheres, they produce more than
// ten times as many, because the projection of a sphere that intersects the plane of the eye is
// unbounded.
TEST(ParticleCounters, ScreenAlignedQuadsAreExpensiveAmongTheSpheres) {
  on_every_driver([](measure::Device& device) {
    const auto ratio = [&](const char* camera) {
      const ParticleWork work = generated_work("uniform", 3000, camera, 96);
      const double ray = static_cast<double>(fragments_of(device, "quad_instanced", work));
      return static_cast<double>(fragments_of(device, "quad_screen", work)) / ray;
    };
    if (fragments_of(device, "quad_screen", generated_work("uniform", 10, "orbit_y:1/8", 8)) == 0) {
      return;  // the device has no geometry shaders
    }
    EXPECT_NEAR(ratio("orbit_y:1/8"), 1, 0.1);
    EXPECT_GT(ratio("path_z:8/10"), 10);
  });
}

}  // namespace
}  // namespace triptych::contract
