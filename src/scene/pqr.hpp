#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Reads one frame of a PQR file as written by PDB2PQR and APBS: ATOM and HETATM records that
// consist of the words "ATOM number name residue [chain] number x y z charge radius". Positions and
// radii are in ångström. Frames are models, or end with END. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_pqr(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
