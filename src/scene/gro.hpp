#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Reads one frame of a GROMACS file. A frame consists of a title, the number of atoms, the atoms in
// fixed columns (with any number of decimals), and the box, which is not used. Frames follow one
// another. Positions are in nanometres. Elements are derived from atom names and residues
// (element_names.hpp). Throws InputError with file and line.
[[nodiscard]] ParticleSet read_gro(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
