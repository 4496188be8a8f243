#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/line_reader.hpp"
#include "scene/particles.hpp"

namespace triptych::scene {

// The data that all text formats have in common: positions, and an element or a type for each atom,
// which determines its radius and colour. `places` and `kinds` have one entry per particle, in the
// order of the file.
struct Atoms {
  std::vector<std::array<double, 3>> places;  // in the file's unit
  std::vector<std::uint32_t> kinds;           // indices into kind_names
  std::vector<std::string> kind_names;
  std::vector<double> radii;        // from the file, one per particle, or empty
  std::vector<std::int64_t> order;  // numbers from the file, one per particle, or empty
  bool elements = true;             // whether kinds are elements; otherwise they are types
  double angstrom = 1;              // the length of an ångström in the file's unit
  std::vector<std::string> notes;   // guesses that were made (ReadFacts::notes)

  // Returns the index of the kind with this name, and adds the kind if it is new.
  [[nodiscard]] std::uint32_t kind(std::string_view name);
  void add(const std::array<double, 3>& place, std::uint32_t kind_index) {
    places.push_back(place);
    kinds.push_back(kind_index);
  }

  // Replaces the names of the kinds; `kinds` must index them already.
  void take_names(Atoms&& other) {
    kind_names = std::move(other.kind_names);
    index_ = std::move(other.index_);
  }

 private:
  std::map<std::string, std::uint32_t, std::less<>> index_;
};

// Converts to spheres, with radii and colours as load_particles documents them. If there is an
// `order`, the spheres are sorted by it and ids are ranks in it, so that they are the same in each
// frame of a trajectory. Throws InputError for a number that appears twice; `first_line` is the
// line of the first atom in the file, which has one atom on each line.
[[nodiscard]] ParticleSet to_particles(Atoms atoms, ColourKind colour, const LineReader& reader,
                                       int first_line = 0);

}  // namespace triptych::scene
