#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "scene/particles.hpp"
#include "scene/progress_steps.hpp"

namespace triptych::scene {

// MegaMol's particle lists, versions 1.0 to 1.3, as its reader takes them. Colours become the
// wanted kind: intensities are grey; a list without intensities has its index among the lists over
// their number, and the rank in between where there is only one. Channels are clamped to [0, 1],
// NaN is 0. Throws InputError with the file and the byte at which something else was expected.
[[nodiscard]] ParticleSet read_mmpld(std::span<const char> content, const std::string& file,
                                     std::uint64_t frame, ColourKind colour,
                                     ProgressSteps progress);

}  // namespace triptych::scene
