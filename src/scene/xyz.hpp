#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Reads one frame of an XYZ file. A frame consists of the number of atoms, a comment, and lines
// with an element (symbol or atomic number), x, y, z and possibly further columns. In extended XYZ,
// the comment contains Properties=NAME:TYPE:COUNT:…, which may put species (or Z) and pos into any
// columns. Frames follow one another. Positions are in ångström. If a word is an atom name and not
// an element, the element is guessed (element_names.hpp). Throws InputError with file and line.
[[nodiscard]] ParticleSet read_xyz(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
