#pragma once
// Finds configurations of particles that do exactly the same work (measure::Suite::plain).

#include "measure/contract/suite.hpp"
#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// Whether no two sprites share a pixel with any technique. False if that is not certain, which is
// the case for spheres that reach the plane of the eye or come near it.
[[nodiscard]] bool sprites_are_apart(const scene::ParticleScene& scene);

// Replaces levels that matter only for another technique or another kind of colour. This includes
// conservative depth, which rejects hidden fragments before shading, if no sprite lies behind
// another one.
[[nodiscard]] measure::PlainWork plain_work(const measure::Configuration& configuration,
                                            const measure::ParticleWork& work);

}  // namespace triptych::particles_suite
