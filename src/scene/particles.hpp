#pragma once
// Particles from a file or a generator (ParticleSet).

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/camera.hpp"
#include "scene/read_facts.hpp"

namespace triptych::scene {

// The source of a particle's colour: the levels of the factor `colour`.
enum class ColourKind : std::uint8_t {
  rgba8,     // four bytes, red in the lowest
  rgba32,    // four floats
  intensity  // one float in [0, 1], coloured by a transfer function
};
[[nodiscard]] std::string_view name_of(ColourKind kind);
[[nodiscard]] ColourKind colour_kind(std::string_view name);  // throws InputError

// Spheres, with one array per property. All arrays that are not empty have the same length. Every
// sphere is finite and has a radius > 0; other particles were dropped and counted.
struct ParticleSet {
  std::string name;  // the `data` factor: a file name or generate:NAME:COUNT
  std::vector<std::array<float, 4>> spheres;  // centre x, y, z and radius, world units
  std::vector<std::uint32_t> ids;  // index in the file, counted from 0 and including the dropped
                                   // ones; ascending unless the set was permuted
  ColourKind colour = ColourKind::rgba8;
  // Only the array that `colour` names is filled. Colours are not premultiplied; alpha is not used,
  // because spheres are opaque.
  std::vector<std::uint32_t> rgba8;
  std::vector<std::array<float, 4>> rgba32;
  std::vector<float> intensity;
  // Number of particles with a radius ≤ 0, or a radius or centre that is not finite.
  std::uint64_t dropped = 0;
  std::string hash;  // content hash of all members above except the name
  ReadFacts facts;   // facts about a file; not part of the hash

  [[nodiscard]] std::size_t count() const noexcept { return spheres.size(); }
};

// The value of ParticleSet::hash, which has to be computed again after a permutation.
[[nodiscard]] std::string particle_hash(const ParticleSet& set);

// The box around all spheres, including their radii; the unit box if there are none.
[[nodiscard]] Box bounding_box(const ParticleSet& set);

// Appends one particle from a file, or counts it as dropped if it cannot be drawn. `index` is its
// position in the file. The caller appends the colour only if this returns true.
[[nodiscard]] bool append(ParticleSet& set, const std::array<double, 4>& sphere,
                          std::uint32_t index);

// Called from time to time while particles are read or generated, with the finished share in [0,
// 1].
using Progress = std::function<void(double share)>;

// Loads particles. `data` has the form used in a plan: "generate:NAME:COUNT"
// (scene/particle_generators.hpp), or a file in one of the formats in scene/particle_formats.hpp,
// plain or compressed with gzip or bzip2. "FILE@K" selects the K-th frame of a trajectory, counted
// from 0; the default is the first one. A relative file name is searched first as it is, then in
// each of `folders`.
//
// Radii: the file's own (MMPLD, PQR, LAMMPS `radius`), otherwise van der Waals radii by element
// (Bondi 1964; 2.0 Å for elements not listed there), in the file's unit of length. LAMMPS types
// without elements get half the median distance to the nearest neighbour. Colours: the file's own
// (MMPLD), otherwise one colour per element or type. Intensity: the file's own, otherwise the index
// of the element or type among those in the file, divided by their number; if there is only one,
// the rank of the particle divided by the number of particles.
//
// Throws InputError with file, line and the expectation that was not met, also for an empty file
// and for a file all of whose particles are dropped. Throws IoError if the file does not exist.
[[nodiscard]] ParticleSet load_particles(std::string_view data, ColourKind colour,
                                         const std::vector<std::filesystem::path>& folders = {},
                                         const Progress& progress = {});

// Throws as load_particles does for generated particles that cannot be made, but does not make
// them. Does not check files.
void check_generated_particles(std::string_view data);

// Whether `data` can be loaded: false for a file that does not exist here.
[[nodiscard]] bool particles_present(std::string_view data,
                                     const std::vector<std::filesystem::path>& folders = {});

}  // namespace triptych::scene
