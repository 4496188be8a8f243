#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// Reads one frame of a LAMMPS dump with named columns. Positions are read from x y z, or else from
// the unwrapped columns xu yu zu, or else from the scaled columns xs ys zs or xsu ysu zsu. An
// atom's radius is read from the file (as radius, or as half the diameter), or else it is derived
// from the element, or else from the type. If the file has ids, the atoms are sorted by id. Throws
// InputError with file and line.
[[nodiscard]] ParticleSet read_lammps_dump(LineReader& reader, std::uint64_t frame,
                                           ColourKind colour);

// Reads a LAMMPS data file. The comment after "Atoms" names the style of the section (atomic,
// charge, bond, angle, molecular, full, sphere and others). Without this comment, the style is
// atomic if the number of columns fits no other style; otherwise the file is rejected. Image flags
// must be whole numbers and are ignored. The atoms are sorted by id. Throws InputError with file
// and line.
[[nodiscard]] ParticleSet read_lammps_data(LineReader& reader, std::uint64_t frame,
                                           ColourKind colour);

}  // namespace triptych::scene
