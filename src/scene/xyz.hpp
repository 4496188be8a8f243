#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Reads XYZ: a count, a comment, then lines with an element (symbol or atomic number), x, y, z and
// possibly further columns. In extended XYZ, the comment contains Properties=NAME:TYPE:COUNT:…,
// which may put species or Z and pos into any columns. Frames follow one another. Positions are in
// ångström. If a word is the name of an atom and not an element, the element is guessed
// (element_names.hpp). Throws InputError with file and line.
[[nodiscard]] ParticleSet read_xyz(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
