#pragma once
// Facts that a reader found in a file in addition to the data, for `render --describe` and for
// warnings about guesses.

#include <cstdint>
#include <string>
#include <vector>

namespace triptych::scene {

struct ReadFacts {
  // Particles of one element or type.
  struct Kind {
    std::string name;
    std::uint64_t count = 0;
  };

  std::string format;              // the name in the table of formats, "PDB"
  std::string unit;                // unit of lengths; empty if the file does not state one
  std::vector<Kind> kinds;         // particles only, in the order in which colours are given
  bool elements = false;           // whether kinds are chemical elements
  std::string value_type;          // volumes only: the type of a value in the file
  std::uint64_t components = 1;    // volumes only: values that the file has for each voxel
  std::string orientation;  // volumes only: the directions of the axes, as the file states them
  std::vector<std::string> notes;  // one sentence for each thing that was guessed or left out
};

}  // namespace triptych::scene
