#pragma once
// What a scene of particles cannot tell apart (measure::Suite::plain).

#include "measure/contract/suite.hpp"
#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// Whether no two sprites share a pixel, whatever technique draws them. False where that is not
// certain: for spheres that reach the eye's plane or come near it.
[[nodiscard]] bool sprites_are_apart(const scene::ParticleScene& scene);

// Levels that another technique or another kind of colour has a use for; and conservative depth,
// which rejects before shading what lies behind something drawn before, where no sprite lies
// behind another.
[[nodiscard]] measure::PlainWork plain_work(const measure::Configuration& configuration,
                                            const measure::ParticleWork& work);

}  // namespace triptych::particles_suite
