#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Reads the Protein Data Bank format with fixed columns: ATOM and HETATM records, in ångström.
// Frames are models; in files without models, frames end with END or ENDMDL. Elements are in
// columns 77 and 78, otherwise they are derived from names and residues (element_names.hpp). An
// entry of the PDB itself, and the last of several frames, must end with END. A line that looks
// like an atom but cannot be read as one is rejected, and so is a number that is not separated from
// its neighbours. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_pdb(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
