#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// A LAMMPS dump with named columns. Positions are x y z, else unwrapped xu yu zu, else scaled xs ys
// zs or xsu ysu zsu. The size of an atom is its radius (or half of its diameter), else follows from
// its element, else from its type. Atoms are sorted by id if there is one. Throws InputError with
// file and line.
[[nodiscard]] ParticleSet read_lammps_dump(LineReader& reader, std::uint64_t frame,
                                           ColourKind colour);

// A LAMMPS data file. Its Atoms section has the style that its comment names (atomic, charge, bond,
// angle, molecular, full, sphere and others), or atomic if the number of columns allows no other.
// Image flags are whole numbers and have no effect. Atoms are sorted by id. Throws InputError with
// file and line.
[[nodiscard]] ParticleSet read_lammps_data(LineReader& reader, std::uint64_t frame,
                                           ColourKind colour);

}  // namespace triptych::scene
