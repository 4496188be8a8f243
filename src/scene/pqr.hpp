#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// PQR, as PDB2PQR and APBS write it: ATOM and HETATM records of words, "ATOM number name residue
// [chain] number x y z charge radius". The radius is the file's own; ångström. Frames are models, or
// what END closes. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_pqr(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
