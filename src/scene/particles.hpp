#pragma once
// Particles that were read from a file or generated.

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

// The format in which a set stores the colours of its particles. The formats are the levels
// (values) of the factor (setting) `colour`.
enum class ColourKind : std::uint8_t {
  rgba8,     // four bytes, with red in the lowest byte
  rgba32,    // four floats
  intensity  // one float in [0, 1], coloured by a transfer function
};
[[nodiscard]] std::string_view name_of(ColourKind kind);
[[nodiscard]] ColourKind colour_kind(std::string_view name);  // throws InputError

// Spheres, with one array per property. All non-empty arrays have the same length. Every sphere is
// finite and has a radius > 0. All other particles were dropped, and `dropped` counts them.
struct ParticleSet {
  std::string name;  // the `data` factor: a file name or generate:NAME:COUNT
  std::vector<std::array<float, 4>> spheres;  // centre x, y, z and radius in world units
  // 0-based indices in the file or, if the file numbers its atoms, 0-based ranks of these numbers.
  // Dropped particles have an index, too, so the ids may have gaps. The ids are in ascending order
  // unless the set was permuted.
  std::vector<std::uint32_t> ids;
  ColourKind colour = ColourKind::rgba8;
  // Only the array that `colour` names is filled. Colours are not premultiplied. Alpha is not used,
  // because spheres are opaque.
  std::vector<std::uint32_t> rgba8;
  std::vector<std::array<float, 4>> rgba32;
  std::vector<float> intensity;
  // The number of particles whose radius is ≤ 0, or whose radius or centre is not finite.
  std::uint64_t dropped = 0;
  std::string hash;  // content hash of all members above except the name
  ReadFacts facts;   // facts about the file; not part of the hash

  [[nodiscard]] std::size_t count() const noexcept { return spheres.size(); }
};

// Returns the value for ParticleSet::hash, which must be recomputed after a permutation.
[[nodiscard]] std::string particle_hash(const ParticleSet& set);

// Returns the box around all spheres, including their radii. Returns the unit box if there are no
// spheres.
[[nodiscard]] Box bounding_box(const ParticleSet& set);

// Appends one particle from a file, or counts it as dropped if it cannot be drawn. `index` is its
// position in the file. The caller must append the colour only if this function returns true.
[[nodiscard]] bool append(ParticleSet& set, const std::array<double, 4>& sphere,
                          std::uint32_t index);

// A function that is called from time to time while particles are read or generated. `share` is the
// finished fraction of the work, in [0, 1].
using Progress = std::function<void(double share)>;

// Loads particles. `data` has the same form as in a plan (a file that defines the configurations to
// measure): "generate:NAME:COUNT" (scene/particle_generators.hpp), or a file in one of the formats
// in scene/particle_formats.hpp, which may be compressed with gzip or bzip2. "FILE@K" selects frame
// K of a trajectory (0-based). The default is the first frame. A relative file name is first looked
// up in the working directory, and then in each of `folders`.
//
// Radii are taken from the file if it has them (MMPLD, PQR, LAMMPS `radius`). Otherwise they are
// the van der Waals radii of the elements (Bondi 1964; 2.0 Å for elements not listed there), in the
// file's unit of length. LAMMPS types without elements get a radius of half the median distance
// between nearest neighbours. Colours are taken from the file if it has them (MMPLD); otherwise
// there is one colour per element or type. Intensities are taken from the file if it has them.
// Otherwise a particle's intensity is the index of its element or type in the list of all n
// elements or types in the file, divided by n. If there is only one element or type, the intensity
// is the particle's rank divided by the number of particles.
//
// Throws InputError with the file, the line and what was expected there. Also throws InputError for
// an empty file, and for a file all of whose particles are dropped. Throws IoError if the file does
// not exist.
[[nodiscard]] ParticleSet load_particles(std::string_view data, ColourKind colour,
                                         const std::vector<std::filesystem::path>& folders = {},
                                         const Progress& progress = {});

// Throws the same exceptions as load_particles() if `data` names particles that cannot be
// generated, but does not generate them. Does not check files.
void check_generated_particles(std::string_view data);

// Returns whether `data` can be loaded: false for a file that does not exist on this machine.
[[nodiscard]] bool particles_present(std::string_view data,
                                     const std::vector<std::filesystem::path>& folders = {});

}  // namespace triptych::scene
