#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/line_reader.hpp"
#include "scene/particles.hpp"
#include "scene/read_facts.hpp"

namespace triptych::scene {

// The atoms read from a text file: the position of each atom, and its element or type, which
// determines its radius and colour. `places` and `kinds` have one entry per atom, in file order.
struct Atoms {
  std::vector<std::array<double, 3>> places;  // in the file's unit
  std::vector<std::uint32_t> kinds;           // indices into kind_names
  std::vector<std::string> kind_names;
  std::vector<double> radii;        // one per atom if the file states radii, otherwise empty
  std::vector<std::int64_t> order;  // one number per atom if the file states them, otherwise empty
  bool elements = true;             // true: the kinds are elements; false: they are numbered types
  double angstrom = 1;              // the length of an ångström in the file's unit
  std::vector<std::string> notes;   // what the reader had to guess (see ReadFacts::notes)
  std::optional<std::uint64_t> frames = {};  // see ReadFacts::frames
  std::optional<BoxEdges> box_edges = {};    // see ReadFacts::box_edges

  // Returns the index of the kind with this name. Adds the kind if it is new.
  [[nodiscard]] std::uint32_t kind(std::string_view name);
  void add(const std::array<double, 3>& place, std::uint32_t kind_index) {
    places.push_back(place);
    kinds.push_back(kind_index);
  }

  // Moves the kind names from `other` to this object. `kinds` must already contain indices into
  // these names.
  void move_names_from(Atoms&& other) {
    kind_names = std::move(other.kind_names);
    index_ = std::move(other.index_);
  }

 private:
  std::map<std::string, std::uint32_t, std::less<>> index_;
};

// Converts the atoms to spheres. Radii and colours are documented at load_particles(). If `order`
// is not empty, the spheres are sorted by these numbers and their ids are their ranks, so that an
// atom has the same id in every frame of a trajectory. Throws InputError for a number that appears
// twice. The error names the line of the atom, assuming one atom per line and the first atom in
// line `first_line`.
[[nodiscard]] ParticleSet to_particles(Atoms atoms, ColourKind colour, const LineReader& reader,
                                       int first_line = 0);

}  // namespace triptych::scene
