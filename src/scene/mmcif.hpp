#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Reads one frame of an mmCIF file from the loop over _atom_site, with type_symbol and Cartn_x, _y
// and _z in ångström. Frames are models (pdbx_PDB_model_num), in the order in which they appear in
// the file. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_mmcif(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
