#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Protein Data Bank, fixed columns: ATOM and HETATM records, ångström. Frames are models. An entry
// (with a HEADER) must reach its END. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_pdb(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
