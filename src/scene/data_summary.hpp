#pragma once
// A short description of a data set, for `render --describe`.

#include <string>
#include <vector>

#include "scene/particles.hpp"
#include "scene/volume.hpp"

namespace triptych::scene {

// Lines of text: format, sizes, spacing and extent with their unit, orientation, range and
// percentiles of the values, a small picture (the largest value along z), and the reader's notes.
[[nodiscard]] std::vector<std::string> summary_of(const Volume& volume);

// Lines of text: format, counts by element or type, extent, radii, a small picture (the number of
// centres along z), and the reader's notes.
[[nodiscard]] std::vector<std::string> summary_of(const ParticleSet& set);

}  // namespace triptych::scene
