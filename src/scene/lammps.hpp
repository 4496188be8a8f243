#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Reads a LAMMPS dump with named columns. Positions are in x y z, otherwise unwrapped in xu yu zu,
// otherwise scaled in xs ys zs or xsu ysu zsu. The size of an atom is its radius (or half of its
// diameter) if the file has one, otherwise it follows from the element, otherwise from the type.
// Atoms are sorted by id if there is one. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_lammps_dump(LineReader& reader, std::uint64_t frame,
                                           ColourKind colour);

// Reads a LAMMPS data file. The comment after "Atoms" names the style of the section (atomic,
// charge, bond, angle, molecular, full, sphere and others). Without it, the style is atomic if the
// number of columns allows no other. Image flags are whole numbers and have no effect. Atoms are
// sorted by id. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_lammps_data(LineReader& reader, std::uint64_t frame,
                                           ColourKind colour);

}  // namespace triptych::scene
