#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Protein Data Bank format with fixed columns: ATOM and HETATM records, in ångström. Frames are
// models, or else end with END or ENDMDL. Elements are in columns 77 and 78, else follow from names
// and residues (element_names.hpp). An entry of the PDB itself and the last of several frames must
// end with END. A line that begins like an atom but cannot be read as one is refused, and so is a
// number that is not separated from its neighbours. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_pdb(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
