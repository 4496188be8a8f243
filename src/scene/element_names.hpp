#pragma once
// Derives the elements of atoms from their atom and residue names, for files that do not state
// elements. For example, CA in the residue ALA is carbon, but CA in the residue CA is calcium.

#include <string>
#include <string_view>

#include "scene/atoms.hpp"

namespace triptych::scene {

struct NamedElement {
  std::string symbol;    // unknown_element if the names do not determine an element
  bool guessed = false;  // true if the element was guessed from the name alone
};

// The symbol for particles that are not atoms, such as the virtual sites of water models.
inline constexpr std::string_view unknown_element = "X";

// Derives the element from the atom's name and its residue. Amino acids, nucleotides, water, lipids
// and sugars contain only H, C, N, O, P and S (and Se in MSE and SEC). An ion has the same name as
// its residue, in the spelling of CHARMM (SOD, CLA, POT), AMBER (Na+, Cl-) or GROMACS (NA, CL).
// Hemes and chlorophylls contain their metal. In any other residue, the element is guessed from the
// atom's name.
[[nodiscard]] NamedElement element_of_name(std::string_view atom, std::string_view residue);

// Derives the element from the four columns of a PDB file that contain the atom's name (13 to 16).
// Symbols are right-aligned in the first two of these columns. In an unknown residue, a name CA
// that begins in column 13 is therefore calcium, and a name CA that begins in column 14 is carbon.
[[nodiscard]] NamedElement element_of_columns(std::string_view columns, std::string_view residue);

// Returns a temporary kind (an index into Atoms::kind_names) for an atom whose element the file
// does not state. name_elements() replaces it with an element. `columns` may contain the blanks
// that align the name.
[[nodiscard]] std::uint32_t unnamed_kind(Atoms& atoms, std::string_view columns,
                                         std::string_view residue);

// Replaces the kinds from unnamed_kind() with elements, and adds a note that lists the guessed
// elements. `aligned` means that the format right-aligns symbols, as PDB does. It has an effect
// only if the names in known residues are really aligned in this way.
void name_elements(Atoms& atoms, bool aligned = false);

}  // namespace triptych::scene
