#pragma once
// A short description of a data set, for `render --describe`.

#include <string>
#include <vector>

#include "scene/particles.hpp"
#include "scene/volume.hpp"

namespace triptych::scene {

// Returns lines that describe a volume: format, size, spacing and extent with their unit,
// orientation, range and percentiles of the values, a small text image that shows the largest value
// along z, and the notes of the file reader.
[[nodiscard]] std::vector<std::string> summary_of(const Volume& volume);

// Returns lines that describe a particle set: format, counts by element or type, extent, radii, a
// small text image that shows the number of particle centres along z, and the notes of the file
// reader.
[[nodiscard]] std::vector<std::string> summary_of(const ParticleSet& set);

}  // namespace triptych::scene
