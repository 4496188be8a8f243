#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// XYZ: count, comment, then lines with element (symbol or atomic number), x, y, z and further
// columns. Extended XYZ has a comment with Properties=NAME:TYPE:COUNT:…, with species or Z and pos
// in any columns. Frames follow one another. Positions are in ångström. If a word is an atom's name
// and not an element, the element is guessed (element_names.hpp). Throws InputError with file and
// line.
[[nodiscard]] ParticleSet read_xyz(LineReader& reader, std::uint64_t frame, ColourKind colour);

}  // namespace triptych::scene
