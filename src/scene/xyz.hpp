#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// XYZ: count, comment, then element (symbol or atomic number), x, y, z and whatever else; extended
// XYZ, whose comment has Properties=NAME:TYPE:COUNT:…, with species or Z and pos in any columns.
// Frames follow one another. Ångström. Words that are atom names, not elements, are guessed
// (element_names.hpp). Throws InputError with file and line.
[[nodiscard]] ParticleSet read_xyz(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
