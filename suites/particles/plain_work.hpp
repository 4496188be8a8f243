#pragma once
// Finds particle configurations that do exactly the same work (measure::Suite::plain).

#include "measure/contract/suite.hpp"
#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// Returns whether no two sprites share a pixel, whichever technique draws them. Returns false if
// this is not certain, which is the case for spheres that reach or come close to the plane of the
// eye.
[[nodiscard]] bool sprites_are_apart(const scene::ParticleScene& scene);

// Replaces levels that have no effect with this technique or kind of colour. If no sprite lies
// behind another one, conservative depth is also replaced, because all that it does is reject
// hidden fragments before they are shaded.
[[nodiscard]] measure::PlainWork plain_work(const measure::Configuration& configuration,
                                            const measure::ParticleWork& work);

}  // namespace triptych::particles_suite
