#pragma once
// Elements of atoms that have a name and a residue only, such as CA in ALA (carbon) or in CA
// (calcium).

#include <string>
#include <string_view>

#include "scene/atoms.hpp"

namespace triptych::scene {

struct NamedElement {
  std::string symbol;    // unknown_element where the name says nothing
  bool guessed = false;  // nothing but the name was there to go by
};

// Of an atom whose name says nothing, such as a virtual site of a water model.
inline constexpr std::string_view unknown_element = "X";

// From the name and the residue: amino acids, nucleotides, water, lipids and sugars have H, C, N, O,
// P and S only (Se in MSE and SEC); an ion has the name of its residue, in the spelling of CHARMM
// (SOD, CLA, POT), AMBER (Na+, Cl-) or GROMACS (NA, CL); hemes and chlorophylls have their metal.
// In any other residue the element is guessed from the name.
[[nodiscard]] NamedElement element_of_name(std::string_view atom, std::string_view residue);

// As element_of_name, for the four columns of a PDB file in which symbols stand in columns 13 and
// 14, adjusted to the right: there "CA  " is calcium and " CA " is carbon, in any residue that is
// not known.
[[nodiscard]] NamedElement element_of_columns(std::string_view columns, std::string_view residue);

// The kind of an atom without an element of its own, until name_elements is called. `columns` may
// have the blanks that adjust the name.
[[nodiscard]] std::uint32_t unnamed_kind(Atoms& atoms, std::string_view columns,
                                         std::string_view residue);

// Gives the kinds of unnamed_kind their elements, and a note to what was guessed. `aligned`: the
// format adjusts symbols to the right, as PDB does; believed only if the names of the known
// residues are adjusted that way.
void name_elements(Atoms& atoms, bool aligned = false);

}  // namespace triptych::scene
