#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "scene/particles.hpp"
#include "scene/progress_steps.hpp"

namespace triptych::scene {

// Reads MegaMol's particle lists, versions 1.0 to 1.3, as MegaMol's own reader does. Colours are
// converted to the requested kind; an intensity becomes a grey colour. In a list without
// intensities, the intensity of every particle is the index of its list divided by the number of
// lists or, if there is only one list, the particle's rank divided by the number of particles.
// Channels are clamped to [0, 1]; NaN becomes 0. Throws InputError with the file and the position
// of the unexpected byte.
[[nodiscard]] ParticleSet read_mmpld(std::span<const char> content, const std::string& file,
                                     std::uint64_t frame, ColourKind colour,
                                     ProgressSteps progress);

}  // namespace triptych::scene
