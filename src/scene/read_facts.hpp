#pragma once
// Facts about a data file that the file reader found in addition to the data, such as the format
// and the unit of length. `render --describe` prints them, and warnings about guesses are based on
// them.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace triptych::scene {

// The three edge vectors of a box.
using BoxEdges = std::array<std::array<double, 3>, 3>;

struct ReadFacts {
  // The number of particles of one element or type.
  struct Kind {
    std::string name;
    std::uint64_t count = 0;
  };

  std::string format;       // the name in the table of formats, such as "PDB"
  std::string unit;         // unit of length; empty if the file does not state a unit
  std::vector<Kind> kinds;  // particles only, in the order in which colours are assigned
  bool elements = false;    // whether kinds are chemical elements
  std::uint64_t frame = 0;  // particles only: 0-based index of the frame that was read
  // Particles only: the number of frames in the file. Absent if the reader does not know it.
  std::optional<std::uint64_t> frames = {};
  // Particles only: the edges of the simulation box, if the file states the box. Positions may be
  // outside the box.
  std::optional<BoxEdges> box_edges = {};
  std::string value_type;        // volumes only: the type of the values in the file
  std::uint64_t components = 1;  // volumes only: number of values per voxel in the file
  std::string orientation;  // volumes only: the directions of the axes, as the file states them
  std::vector<std::string> notes;  // one sentence for each guess or omission
};

}  // namespace triptych::scene
