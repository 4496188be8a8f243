#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "scene/particles.hpp"
#include "scene/progress_steps.hpp"

namespace triptych::scene {

// Reads MegaMol's particle lists, versions 1.0 to 1.3, with the same results as MegaMol's own
// reader. Colours are converted to the requested format, and an intensity becomes a shade of grey.
// In a list without intensities, each particle's intensity is the index of the list divided by the
// number of lists or, if there is only one list, the particle's rank divided by the number of
// particles. Channels are clamped to [0, 1], and NaN becomes 0. Throws InputError with the file and
// the position of the unexpected byte.
[[nodiscard]] ParticleSet read_mmpld(std::span<const char> content, const std::string& file,
                                     std::uint64_t frame, ColourKind colour,
                                     ProgressSteps progress);

}  // namespace triptych::scene
