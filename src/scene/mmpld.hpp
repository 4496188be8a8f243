#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "scene/particles.hpp"
#include "scene/progress_steps.hpp"

namespace triptych::scene {

// Reads MegaMol's particle lists, versions 1.0 to 1.3, in the way its own reader does. Colours are
// converted to the wanted kind. Intensities become grey. In a list without intensities, every
// particle gets the index of its list divided by the number of lists or, if there is only one list,
// its own rank in between. Channels are clamped to [0, 1]; NaN becomes 0. Throws InputError with
// the file and the position of the byte at which something else was expected.
[[nodiscard]] ParticleSet read_mmpld(std::span<const char> content, const std::string& file,
                                     std::uint64_t frame, ColourKind colour,
                                     ProgressSteps progress);

}  // namespace triptych::scene
