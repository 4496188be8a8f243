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

// What the text formats have in common: places, and elements or types that decide radius and
// colour. One entry per particle in `places` and `kinds`, as in the file.
struct Atoms {
  std::vector<std::array<double, 3>> places;  // in the file's unit
  std::vector<std::uint32_t> kinds;           // indices into kind_names
  std::vector<std::string> kind_names;
  std::vector<double> radii;        // the file's own, one per particle, or none
  std::vector<std::int64_t> order;  // the file's own numbers, one per particle, or none
  bool elements = true;             // whether kinds are elements; else they are types
  double angstrom = 1;              // how long an ångström is in the file's unit
  std::vector<std::string> notes;   // what had to be guessed (ReadFacts::notes)

  // The index of a kind, which is new or known.
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

// Spheres with radii and colours as load_particles documents them, in ascending `order` where there
// is one: ids are then ranks in it, the same in each frame of a trajectory. Throws InputError for a
// number given twice; `first_line` is where the first atom stands in the file, one on each line.
[[nodiscard]] ParticleSet to_particles(Atoms atoms, ColourKind colour, const LineReader& reader,
                                       int first_line = 0);

}  // namespace triptych::scene
