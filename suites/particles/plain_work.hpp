#pragma once
// Finds particle configurations that do exactly the same work (measure::Suite::plain).

#include "measure/contract/suite.hpp"
#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// Returns whether no two sprites share a pixel, regardless of the technique that draws them.
// Returns false if this is not certain, which is the case for spheres that reach or come close to
// the plane of the eye.
[[nodiscard]] bool sprites_are_apart(const scene::ParticleScene& scene);

// Replaces levels that have no effect with this technique or colour format. If no sprite lies
// behind another sprite, conservative depth is also replaced, because its only effect is to reject
// hidden fragments before they are shaded.
[[nodiscard]] measure::PlainWork plain_work(const measure::Configuration& configuration,
                                            const measure::ParticleWork& work);

}  // namespace triptych::particles_suite
