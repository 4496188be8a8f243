#pragma once
#include <cstdint>

#include "scene/atoms.hpp"
#include "scene/line_reader.hpp"

namespace triptych::scene {

// A LAMMPS dump: columns by name. Places are x y z, else unwrapped xu yu zu, else scaled xs ys zs
// or xsu ysu zsu; radius (or half of diameter), else element, else type decides how large an atom
// is. Sorted by id where there is one. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_lammps_dump(LineReader& reader, std::uint64_t frame,
                                           ColourKind colour);

// A LAMMPS data file: its Atoms section in the style that its comment names (atomic, charge, bond,
// angle, molecular, full, sphere and others), or atomic where its columns leave no doubt. Image
// flags are whole numbers and have no effect. Sorted by id. Throws InputError with file and line.
[[nodiscard]] ParticleSet read_lammps_data(LineReader& reader, std::uint64_t frame,
                                           ColourKind colour);

}  // namespace triptych::scene
