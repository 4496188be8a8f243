#include "scene/element_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "scene/elements.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

using Names = std::set<std::string, std::less<>>;

// Residues that contain only the elements H, C, N, O, P and S. The list contains the PDB's standard
// residues and the residues of the force fields AMBER, CHARMM, GROMOS and OPLS, spelled as in the
// programs that use these force fields.
constexpr std::string_view organic_residues =
    // amino acids, their protonation states and caps
    "ALA ARG ASN ASP CYS GLN GLU GLY HIS ILE LEU LYS MET PHE PRO SER THR TRP TYR VAL ASX GLX PYL "
    "HID HIE HIP HSD HSE HSP HISA HISB HISD HISE HISH HIS1 HIS2 CYX CYM CYS1 CYS2 CYSH CYN ASH "
    "ASPH "
    "ASPP GLH GLUH GLUP LYN LYSH LSN LYP ARGN ARN TYM QLN PGLU ACE NME NMA NH2 NHE FOR FME HYP PCA "
    "SEP TPO PTR CSO CSD CME OCS KCX MLY M3L MLZ ABA AIB ORN NLE CGU UNK DAL DSN "
    // nucleotides
    "A C G U T I DA DC DG DT DU DI RA RC RG RU ADE CYT GUA URA THY PSU 5MU 5MC 7MG 1MA 2MG H2U "
    "OMC OMG OMU OMA M2G ATP ADP AMP GTP GDP GMP CTP UTP NAD NAP NDP FAD FMN SAM SAH COA ACO "
    // water, alcohols and buffers
    "HOH WAT SOL H2O DOD TIP TIP3 TIP4 TIP5 TP3 TP4 TP5 T3P T4P TIP3P SPC SPCE HO4 HO5 OPC "
    "GOL EDO PEG PGE MPD DMS ACT SO4 PO4 EOH IPA ACN TRS MES EPE CIT FMT BME "
    // lipids
    "POPC POPE POPS POPG POPA DPPC DPPE DOPC DOPE DOPS DOPG DMPC DMPG DLPC DLPE DSPC DSPE DPC SDS "
    "CHL1 CHOL CLR PC PE PA OL ST LAPAO LDAO OLA PLM STE "
    // sugars
    "NAG NDG MAN BMA GLC BGC GAL GLA FUC FUL SIA XYP AGLC BGLC AGAL BGAL AMAN BMAN BGLCNA "
    "0GA 4GA 0GB 4GB 4YB UYB VMB 0MA 2MA 0LB 0SA ROH";

constexpr std::string_view hemes = "HEM HEC HEA HEB HEO HAS HDD HEME HEMA";
constexpr std::string_view chlorophylls = "CLA CHL BCL BCB PHO";

// Ion names that differ from the element's symbol.
constexpr std::array<std::pair<std::string_view, std::string_view>, 18> ion_names{{{"SOD", "Na"},
                                                                                   {"CLA", "Cl"},
                                                                                   {"CHL", "Cl"},
                                                                                   {"CHLA", "Cl"},
                                                                                   {"POT", "K"},
                                                                                   {"CAL", "Ca"},
                                                                                   {"CES", "Cs"},
                                                                                   {"LIT", "Li"},
                                                                                   {"RUB", "Rb"},
                                                                                   {"BAR", "Ba"},
                                                                                   {"CAD", "Cd"},
                                                                                   {"MAG", "Mg"},
                                                                                   {"ZIN", "Zn"},
                                                                                   {"IOD", "I"},
                                                                                   {"CIO", "Cs"},
                                                                                   {"IM", "Cl"},
                                                                                   {"IP", "Na"},
                                                                                   {"BRO", "Br"}}};

// Two-letter symbols that are not mistaken for the name of an organic atom. Such a name begins with
// a one-letter symbol. The second letter is a Greek letter in Latin transcription (A, B, G, D, E,
// Z, H) or the symbol of a bound atom. The combinations in this list are not common as such names.
constexpr std::string_view clear_symbols = "CL BR SI SE FE CU NI PT PB CR IR";
constexpr std::string_view one_letter_symbols = "HBCNOFPSKVYIWUD";

Names split_names(std::string_view list) {
  Names names;
  for (const std::string_view word : split_words(list)) names.emplace(word);
  return names;
}

bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}

std::string upper_case(std::string_view text) {
  std::string upper(trimmed(text));
  for (char& c : upper) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return upper;
}

// Returns the first run of letters, such as "CA" in "1CA3".
std::string_view first_letters(std::string_view upper) {
  while (!upper.empty() && !is_upper(upper.front())) upper.remove_prefix(1);
  const auto end = std::ranges::find_if_not(upper, is_upper);
  return upper.substr(0, static_cast<std::size_t>(end - upper.begin()));
}

// Returns whether the residue is organic. Also recognizes the residues at the ends of a chain,
// whose names AMBER marks with an additional character, for example NALA and CALA, A5 and A3, DA5
// and DA3.
bool is_organic(const std::string& residue) {
  static const Names known = split_names(organic_residues);
  if (known.contains(residue)) return true;
  const std::string_view name = residue;
  if (name.size() == 4 && (name[0] == 'N' || name[0] == 'C') && known.contains(name.substr(1))) {
    return true;
  }
  return name.size() > 1 && (name.back() == '5' || name.back() == '3' || name.back() == 'N') &&
         name.size() <= 3 && known.contains(name.substr(0, name.size() - 1));
}

std::string_view ion_of(std::string_view letters) {
  const auto found =
      std::ranges::find(ion_names, letters, &std::pair<std::string_view, std::string_view>::first);
  return found == ion_names.end() ? std::string_view{} : found->second;
}

// Returns the element if a word names an ion, either by the element's symbol or in a force field's
// spelling. Otherwise returns an empty string.
std::string ion_symbol(std::string_view letters) {
  if (const std::string_view ion = ion_of(letters); !ion.empty()) return std::string(ion);
  return atomic_number(letters) ? proper_symbol(letters) : std::string{};
}

// Returns the element of an ion, or an empty string. An ion is the only atom of its residue, and
// the atom and the residue have the same name.
std::string element_of_ion(std::string_view atom, std::string_view residue) {
  const std::string symbol = ion_symbol(atom);
  if (symbol.empty()) return {};
  if (atom == residue || residue == "ION" || residue == "IONS") return symbol;
  // One of the two names may be an element's symbol, such as NA, while the other is a force field's
  // spelling of the same ion, such as SOD.
  const bool is_known_spelling = !ion_of(residue).empty() || !ion_of(atom).empty();
  return is_known_spelling && ion_symbol(residue) == symbol ? symbol : std::string{};
}

std::string organic_element(std::string_view letters) {
  constexpr std::string_view elements = "HCNOPSD";
  const bool known = !letters.empty() && elements.find(letters.front()) != std::string_view::npos;
  return std::string(known ? letters.substr(0, 1) : unknown_element);
}

std::string guessed_element(std::string_view letters) {
  if (letters.empty()) return std::string(unknown_element);
  const std::string_view first_two = letters.substr(0, 2);
  static const Names clear = split_names(clear_symbols);
  const bool halogen = first_two == "CL" || first_two == "BR";
  if (clear.contains(first_two) && (letters.size() == 2 || halogen))
    return proper_symbol(first_two);
  if (one_letter_symbols.find(letters.front()) != std::string_view::npos) {
    return std::string(letters.substr(0, 1));
  }
  return atomic_number(first_two) ? proper_symbol(first_two) : std::string(unknown_element);
}

// Returns the element that follows from the residue, or an empty string if the residue is not
// known.
std::string element_of_residue(std::string_view letters, const std::string& residue) {
  static const Names heme_names = split_names(hemes);
  static const Names chlorophyll_names = split_names(chlorophylls);
  if (std::string ion = element_of_ion(letters, first_letters(residue)); !ion.empty()) return ion;
  if (residue == "MSE" || residue == "SEC" || residue == "CSE") {
    return letters == "SE" ? "Se" : organic_element(letters);
  }
  if (heme_names.contains(residue)) return letters == "FE" ? "Fe" : organic_element(letters);
  if (chlorophyll_names.contains(residue)) return letters == "MG" ? "Mg" : organic_element(letters);
  return is_organic(residue) ? organic_element(letters) : std::string{};
}

// The separator in the name of a kind whose element is not yet known. Such a name has the form
// "\x01NAME\x01RESIDUE" and cannot be confused with a symbol from a file.
constexpr char unnamed_mark = '\x01';

struct Unnamed {
  std::string_view columns;
  std::string_view residue;
};

std::optional<Unnamed> as_unnamed(std::string_view kind) {
  if (!kind.starts_with(unnamed_mark)) return std::nullopt;
  kind.remove_prefix(1);
  const std::size_t end = kind.find(unnamed_mark);
  return Unnamed{kind.substr(0, end), kind.substr(end + 1)};
}

// Returns whether the atom names in known residues are aligned as in PDB files, where an element's
// symbol ends in the second of the four columns of the name. Some programs left-align all names
// instead.
bool are_aligned(const Atoms& atoms) {
  bool any = false;
  for (const std::string& kind : atoms.kind_names) {
    const auto unnamed = as_unnamed(kind);
    if (!unnamed) continue;
    const std::string_view columns = unnamed->columns;
    const bool to_the_right = columns.front() == ' ';
    any |= to_the_right;
    const bool short_name = trimmed(columns).size() < 4;
    const std::string residue = upper_case(unnamed->residue);
    const std::string symbol = element_of_residue(first_letters(upper_case(columns)), residue);
    const bool first_is_letter = is_upper(upper_case(columns.substr(0, 1)).front());
    if (!to_the_right && first_is_letter && short_name && symbol.size() == 1) return false;
  }
  return any;
}

// Returns a list such as "C 8, Cl 2".
std::string listed(const std::map<std::string, std::uint64_t>& counts) {
  std::string list;
  for (const auto& [symbol, count] : counts) {
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", symbol, count);
  }
  return list;
}

}  // namespace

NamedElement element_of_name(std::string_view atom, std::string_view residue) {
  const std::string name = upper_case(atom);
  const std::string_view letters = first_letters(name);
  if (std::string known = element_of_residue(letters, upper_case(residue)); !known.empty()) {
    const bool guessed = known == unknown_element;
    return {std::move(known), guessed};
  }
  return {guessed_element(letters), true};
}

NamedElement element_of_columns(std::string_view columns, std::string_view residue) {
  const std::string name = upper_case(columns);
  const std::string_view letters = first_letters(name);
  if (std::string known = element_of_residue(letters, upper_case(residue)); !known.empty()) {
    const bool guessed = known == unknown_element;
    return {std::move(known), guessed};
  }
  const bool at_the_left = !columns.empty() && columns.front() != ' ';
  if (at_the_left && name.size() < 4 && letters.size() >= 2 && name.front() == letters.front() &&
      atomic_number(letters.substr(0, 2))) {
    return {proper_symbol(letters.substr(0, 2))};
  }
  // Some programs write bromine one column too far to the right, in column 14. No boron atom has
  // such a name.
  if (letters == "BR") return {"Br", true};
  const bool one_letter =
      !letters.empty() && one_letter_symbols.find(letters.front()) != std::string_view::npos;
  if (!at_the_left && one_letter) return {std::string(letters.substr(0, 1))};
  return {guessed_element(letters), true};
}

std::uint32_t unnamed_kind(Atoms& atoms, std::string_view columns, std::string_view residue) {
  // The key usually fits into the string object itself (small-string optimization), so building a
  // key for every atom does not allocate memory.
  std::string key(1, unnamed_mark);
  key += columns.empty() ? std::string_view(" ") : columns;
  key += unnamed_mark;
  key += trimmed(residue);
  return atoms.kind(key);
}

void name_elements(Atoms& atoms, bool aligned) {
  const bool by_columns = aligned && are_aligned(atoms);
  std::vector<std::uint64_t> counts(atoms.kind_names.size());
  for (const std::uint32_t kind : atoms.kinds) ++counts[kind];
  std::map<std::string, std::uint64_t> guesses;
  std::uint64_t guessed = 0;
  Atoms named;
  std::vector<std::uint32_t> renamed;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    const std::string& name = atoms.kind_names[kind];
    const auto unnamed = as_unnamed(name);
    if (!unnamed) {
      renamed.push_back(named.kind(name));
      continue;
    }
    const NamedElement element = by_columns ? element_of_columns(unnamed->columns, unnamed->residue)
                                            : element_of_name(unnamed->columns, unnamed->residue);
    renamed.push_back(named.kind(element.symbol));
    if (!element.guessed) continue;
    guessed += counts[kind];
    guesses[element.symbol] += counts[kind];
  }
  for (std::uint32_t& kind : atoms.kinds) kind = renamed[kind];
  atoms.move_names_from(std::move(named));
  if (guessed > 0) {
    atoms.notes.push_back(
        fmt::format("the file does not specify the element of {} atom{} in unknown residues; the "
                    "elements were guessed from the atom names: {}",
                    guessed, guessed == 1 ? "" : "s", listed(guesses)));
  }
}

}  // namespace triptych::scene
