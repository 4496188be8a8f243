// Tests that configurations that the suites declare as equivalent in a scene
// (measure::Suite::plain) do the same work on every device: the counts are equal and the images are
// bit-identical.

#include "measure/contract/equivalents.hpp"
#include "particle_scenes.hpp"
#include "suites/particles/plain_work.hpp"
#include "suites/volume/plain_work.hpp"

namespace triptych::contract {
namespace {

measure::Work full_volume(const measure::Device& device) {
  measure::Work work = default_work(device, scene::generate_volume("uniform_box", {17, 17, 17}),
                                    small_scene("haze"));
  std::get<measure::VolumeWork>(work.scene).options.ert = 0;
  return work;
}

void expect_same_work(measure::Device& device, const measure::Work& a, const measure::Work& b) {
  EXPECT_EQ(counts_of(device, a), counts_of(device, b));
  EXPECT_EQ(draw(device, a), draw(device, b));
}

TEST(SameWork, LeapsInAVolumeWithoutEmptyBricks) {
  on_every_driver([](measure::Device& device) {
    const measure::Work without = [&] {
      measure::Work work = full_volume(device);
      std::get<measure::VolumeWork>(work.scene).options.skip = technique::Skip::none;
      return work;
    }();
    measure::Work leaps = without;
    auto& volume = std::get<measure::VolumeWork>(leaps.scene);
    volume.options.skip = technique::Skip::distance;
    const auto plain = volume_suite::plain_work(
        {{"technique", "raycast"}, {"skip", "distance"}, {"ert", "0"}}, volume);
    ASSERT_EQ(plain.levels.at("skip"), "none");
    expect_same_work(device, without, leaps);
  });
}

TEST(SameWork, EarlyTerminationThatNoRayReaches) {
  on_every_driver([](measure::Device& device) {
    const measure::Work never = full_volume(device);
    const core::Image image = draw(device, never);
    const double least = measure::least_transmittance(never, image);
    ASSERT_GT(least, 0);
    ASSERT_LT(least, 0.9);
    measure::Work ending = never;
    auto& ert = std::get<measure::VolumeWork>(ending.scene).options.ert;
    ert = 0.99 * least;
    expect_same_work(device, never, ending);
    ert = 1.01 * least;  // ends at least one ray early
    EXPECT_NE(counts_of(device, never), counts_of(device, ending));
  });
}

TEST(SameWork, ConservativeDepthWithoutOverlaps) {
  on_every_driver([](measure::Device& device) {
    const ParticleWork work =
        particle_work(particles_of({{-1.5, 0, 0, 0.4}, {1.5, 0.3, 0.5, 0.3}, {0, -1.2, -1, 0.2}}),
                      camera_looking_at({0, 0, 6}, {0, 0, 0}, 50), 96, 96);
    ASSERT_TRUE(particles_suite::sprites_are_apart(work.scene));
    with_every_technique(device, work, [&](const measure::Work& off) {
      measure::Work on = off;
      std::get<ParticleWork>(on.scene).options.conservative_depth = true;
      expect_same_work(device, off, on);
    });
  });
}

}  // namespace
}  // namespace triptych::contract
