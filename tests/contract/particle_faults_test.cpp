// Tests that images reveal each injected fault, with every technique that implements the fault.

#include "measure/protocol/injected_fault.hpp"
#include "particle_scenes.hpp"

namespace triptych::contract {
namespace {

struct Injected {
  const char* name;
  ParticleWork work;
};

// Returns the faults, each with a scene that reveals it. The fault `small_sprite`, which shrinks
// the rectangle of pixels around a sphere, needs small spheres: `tiles` tests a small sphere only
// for the pixels of this rectangle, but a large sphere for all pixels of the quarters of tiles that
// the rectangle reaches. The fault `unresolved_ties` needs coincident spheres, and `lost_at_border`
// needs spheres that overlap several tiles.
std::vector<Injected> faults() {
  std::vector<Injected> all;
  all.push_back({"small_sprite", generated_work("uniform", 10000, "orbit_y:1/8", 200)});
  all.push_back({"unresolved_ties", generated_work("coincident", 4000, "orbit_y:1/8", 96)});
  all.push_back({"reversed_depth", generated_work("uniform", 2000, "orbit_y:1/8", 96)});
  all.push_back({"culled_visible", generated_work("uniform", 50000, "orbit_y:1/8", 96)});
  all.push_back({"lost_at_border", generated_work("uniform", 500, "orbit_y:1/8", 200)});
  all.push_back({"small_box", generated_work("uniform", 500, "orbit_y:1/8", 200)});
  all.push_back({"missing_barrier", generated_work("uniform", 20000, "orbit_y:1/8", 128)});
  return all;
}

TEST(ParticleFaults, EveryFaultChangesTheImage) {
  on_every_driver([](measure::Device& device) {
    for (const Injected& injected : faults()) {
      SCOPED_TRACE(injected.name);
      const reference::SphereTruth truth = truth_of(injected.work);
      const core::Image expected = truth.image();
      const core::Image bound = truth.bound_image();
      with_every_technique(device, injected.work, [&](const measure::Work& whole) {
        measure::Work faulty = whole;
        measure::inject(injected.name, faulty);
        // returns if the technique does not contain the code that this fault would break
        if (device.unsupported(faulty)) return;
        EXPECT_FALSE(accuracy::compare(draw(device, faulty), expected, bound).within_bound());
      });
    }
  });
}

// The fault `wrong_sense` makes the early depth test use the back of a sphere instead of its front.
// If a driver does not reject fragments early, the image cannot reveal the fault. Therefore each
// backend's own tests examine the shader.
TEST(ParticleFaults, TheWrongSenseIsFoundWhereFragmentsAreRejectedEarly) {
  on_every_driver([](measure::Device& device) {
    ParticleWork work = studded_wall();
    work.options.conservative_depth = true;
    const reference::SphereTruth truth = truth_of(work);
    for (const char* technique : {"tiles", "bvh", "quad_instanced"}) {
      SCOPED_TRACE(technique);
      const bool rejects_in_own_code =
          std::string_view(technique) != "quad_instanced" || device.info().api == "opencl";
      measure::Work faulty{.technique = technique, .scene = work};
      expect_true(draw(device, faulty), truth);
      measure::inject("wrong_sense", faulty);
      if (!rejects_in_own_code || device.unsupported(faulty)) continue;
      EXPECT_FALSE(accuracy::compare(draw(device, faulty), truth.image(), truth.bound_image())
                       .within_bound());
    }
  });
}

// An injected slowdown adds work but does not change the image.
TEST(ParticleFaults, AnInjectedSlowdownLeavesTheImageUnchanged) {
  on_every_driver([](measure::Device& device) {
    const ParticleWork work = generated_work("uniform", 3000, "orbit_y:1/8", 96);
    with_every_technique(device, work, [&](const measure::Work& whole) {
      measure::Work slowed = whole;
      measure::inject("slowdown:20", slowed);
      EXPECT_EQ(draw(device, slowed), draw(device, whole));
    });
  });
}

}  // namespace
}  // namespace triptych::contract
