#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Protein Data Bank, fixed columns: ATOM and HETATM records, ångström. Frames are models, or
// else what END closes. An entry (with a HEADER) and the last of several frames must reach END.
// Throws InputError with file and line.
[[nodiscard]] ParticleSet read_pdb(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
