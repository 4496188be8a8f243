#pragma once
// Derives the elements of atoms from an atom name and a residue name, for files that state no
// elements. For instance, CA in the residue ALA is carbon, but CA in the residue CA is calcium.

#include <string>
#include <string_view>

#include "scene/atoms.hpp"

namespace triptych::scene {

struct NamedElement {
  std::string symbol;    // unknown_element if the name does not determine one
  bool guessed = false;  // true if the element was guessed from the name alone
};

// The element of a particle that is not an atom, such as a virtual site of a water model.
inline constexpr std::string_view unknown_element = "X";

// Derives the element from the name and the residue: amino acids, nucleotides, water, lipids and
// sugars contain only H, C, N, O, P and S (and Se in MSE and SEC); an ion has the name of its
// residue, in the spelling of CHARMM (SOD, CLA, POT), AMBER (Na+, Cl-) or GROMACS (NA, CL); hemes
// and chlorophylls contain their metal. In any other residue the element is guessed from the name.
[[nodiscard]] NamedElement element_of_name(std::string_view atom, std::string_view residue);

// Like element_of_name, for the four columns of a PDB file, in which symbols are right-aligned in
// columns 13 and 14: in a residue that is not known, "CA " is calcium and " CA " is carbon.
[[nodiscard]] NamedElement element_of_columns(std::string_view columns, std::string_view residue);

// The kind of an atom whose element the file does not state. It is valid until name_elements is
// called. `columns` may contain the blanks that align the name.
[[nodiscard]] std::uint32_t unnamed_kind(Atoms& atoms, std::string_view columns,
                                         std::string_view residue);

// Replaces the kinds of unnamed_kind by elements, and adds a note about the guessed ones.
// `aligned`: the format right-aligns symbols, as PDB does; this is used only if the names of the
// known residues are aligned in this way.
void name_elements(Atoms& atoms, bool aligned = false);

}  // namespace triptych::scene
