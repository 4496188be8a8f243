#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Reads the ATOM and HETATM records of one frame of a file in the fixed-column Protein Data Bank
// format. Positions are in ångström. Frames are models. In files without models, frames end with
// END or ENDMDL. Elements are read from columns 77 and 78, or else derived from names and residues
// (element_names.hpp). An entry from the PDB itself must contain END, and the last of several
// frames must end with END or ENDMDL. The reader rejects a line that looks like an atom but cannot
// be read as one, and a number that is not separated from neighbouring columns. Throws InputError
// with file and line.
[[nodiscard]] ParticleSet read_pdb(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
