#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// GROMACS: title, count, atoms in fixed columns (any number of decimals), box. Frames follow one
// another. Positions are in nanometres. Elements are derived from names and residues
// (element_names.hpp). The box is not used. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_gro(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
