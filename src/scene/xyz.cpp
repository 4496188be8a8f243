#include "scene/xyz.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "scene/element_names.hpp"
#include "scene/elements.hpp"
#include "scene/xyz_comment.hpp"

namespace triptych::scene {
namespace {

// The columns of a line that contain the element and the position.
struct XyzColumns {
  std::size_t element = 0;
  std::size_t place = 1;
  bool numbered = false;  // the file declares that the element is an atomic number
  // The number of columns that the file declares. A plain XYZ file does not declare a number, and
  // its lines may have further columns.
  std::optional<std::size_t> count;
};

std::string_view next_part(std::string_view& list) {
  const std::size_t end = std::min(list.find(':'), list.size());
  const std::string_view part = list.substr(0, end);
  list.remove_prefix(std::min(end + 1, list.size()));
  return part;
}

// Parses Properties=NAME:TYPE:COUNT:…, whose items have the same order as the columns.
XyzColumns stated_columns(std::string_view list, const LineReader& reader) {
  constexpr std::size_t most_columns = 10'000;
  std::optional<std::size_t> species;
  std::optional<std::size_t> number;
  std::optional<std::size_t> place;
  std::size_t count = 0;
  do {
    const std::string name = lower_case(next_part(list));
    const std::string type = lower_case(next_part(list));
    const std::string_view word = next_part(list);
    const auto columns = parse_number<std::size_t>(word);
    if (!columns || *columns == 0 || *columns > most_columns) {
      reader.reject(fmt::format("expected Properties=NAME:TYPE:COUNT:…, found the count '{}'",
                                quotable(word)));
    }
    if (type.size() != 1 || std::string_view("rils").find(type) == std::string_view::npos) {
      reader.reject(
          fmt::format("expected Properties=NAME:TYPE:COUNT:… with type R, I, L or S, "
                      "found '{}'",
                      quotable(type)));
    }
    if (name == "species" && *columns == 1) species = count;
    if (name == "z" && *columns == 1) number = count;
    if (name == "pos" && *columns == 3) place = count;
    count += *columns;
  } while (!list.empty());
  if ((!species && !number) || !place) {
    reader.reject("expected Properties with species or Z (1 column) and pos (3 columns)");
  }
  return {.element = species ? *species : *number,
          .place = *place,
          .numbered = !species,
          .count = count};
}

XyzColumns columns_of(std::string_view text, const LineReader& reader) {
  const XyzComment comment = parse_xyz_comment(text);
  if (!comment.error.empty()) {
    reader.reject(fmt::format(
        "the comment contains 'Properties=' but is not valid extended XYZ: {}", comment.error));
  }
  return comment.properties ? stated_columns(*comment.properties, reader) : XyzColumns{};
}

// Parses a number, which may also be in the notation of Fortran (1.0D+00) or Mathematica (8.4*^-6).
double xyz_number(std::string_view word, std::string_view what, const LineReader& reader) {
  const std::size_t mark = word.find_first_of("dD*");
  if (mark == std::string_view::npos) return reader.number(word, what);
  std::string plain(word);
  if (word.substr(mark).starts_with("*^")) {
    plain.replace(mark, 2, "e");
  } else if (word[mark] != '*') {
    plain[mark] = 'e';
  }
  // If this is still not a number, the error quotes the original word.
  const auto value = parse_number<double>(plain);
  return value ? *value : reader.number(word, what);
}

// Splits a line into words. A word in quotes may contain blanks.
void split_quoted_into(std::string_view line, std::vector<std::string_view>& words,
                       const LineReader& reader) {
  if (line.find('"') == std::string_view::npos) {
    split_words_into(line, words);
    return;
  }
  words.clear();
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const bool quoted = line[at] == '"';
    const std::size_t begin = quoted ? at + 1 : at;
    std::size_t end = begin;
    while (end < line.size() &&
           (quoted ? line[end] != '"' : line[end] != ' ' && line[end] != '\t')) {
      end += line[end] == '\\' && quoted ? std::size_t{2} : std::size_t{1};
    }
    if (quoted && end >= line.size()) reader.reject("expected a closing quote");
    words.push_back(line.substr(begin, end - begin));
    at = end + (quoted ? 1 : 0);
  }
}

void add_xyz_atom(Atoms& atoms, const std::vector<std::string_view>& words,
                  const XyzColumns& columns, const LineReader& reader) {
  if (!columns.count && words.size() < 4) {
    reader.reject("expected an element, x, y and z" + reader.truncation_hint());
  }
  if (columns.count && words.size() != *columns.count) {
    reader.reject(fmt::format("expected {} columns, as declared by Properties, found {}",
                              *columns.count, words.size()));
  }
  const std::string_view word = words[columns.element];
  if (const auto number = parse_number<int>(word)) {
    if (!symbol_of(*number)) {
      reader.reject(fmt::format("expected an element, found '{}'", quotable(word)));
    }
  } else if (columns.numbered || word.find_first_of("0123456789_-+.") == 0) {
    reader.reject(fmt::format("expected an element, found '{}'", quotable(word)));
  }
  atoms.add({xyz_number(words[columns.place], "x", reader),
             xyz_number(words[columns.place + 1], "y", reader),
             xyz_number(words[columns.place + 2], "z", reader)},
            atoms.kind(word));
}

// Returns the letters at the beginning of a word, such as "C" for "C12".
std::string_view letters_of_word(std::string_view word) {
  return word.substr(0, word.find_first_of("0123456789_-+."));
}

// Returns whether a word is an atom name from a protein, such as "CB" or "HG", and not an element.
// If a file contains such names, a "CA" in it is also an atom name.
bool is_atom_name(std::string_view word) {
  const std::string_view letters = letters_of_word(word);
  const bool upper = std::ranges::all_of(letters, [](char c) { return c >= 'A' && c <= 'Z'; });
  return upper && letters.size() > 1 && !atomic_number(letters) &&
         std::string_view("HCNOPS").find(letters.front()) != std::string_view::npos;
}

std::string symbol_of_number(std::string_view word) {
  const auto number = parse_number<int>(word);
  return number ? std::string(symbol_of(*number).value_or("")) : std::string();
}

void note_numbers(Atoms& atoms) {
  std::vector<std::string> read_as;
  for (const std::string& word : atoms.kind_names) {
    if (const std::string symbol = symbol_of_number(word); !symbol.empty()) {
      read_as.push_back(fmt::format("{} as {}", word, symbol));
    }
  }
  if (read_as.empty()) return;
  constexpr std::size_t most_listed = 6;
  const bool all = read_as.size() <= most_listed;
  if (!all) read_as.resize(most_listed);
  atoms.notes.push_back(
      fmt::format("the first column contains numbers, which are read as atomic numbers: {}{}; if "
                  "they are LAMMPS types instead, name the elements with dump_modify, or write a "
                  ".lammpstrj file, which preserves the types",
                  fmt::join(read_as, ", "), all ? "" : ", …"));
}

// Converts the words in the file to elements.
void name_words(Atoms& atoms, bool numbered) {
  if (!numbered) note_numbers(atoms);
  const bool names = std::ranges::any_of(atoms.kind_names, is_atom_name);
  Atoms named;
  std::vector<std::uint32_t> renamed;
  for (const std::string& word : atoms.kind_names) {
    const std::string_view letters = letters_of_word(word);
    const bool is_name = letters.size() > 1 && letters[1] >= 'A' && letters[1] <= 'Z';
    if (const std::string symbol = symbol_of_number(word); !symbol.empty()) {
      renamed.push_back(named.kind(symbol));
    } else if (names && is_name) {
      renamed.push_back(unnamed_kind(named, word, ""));
    } else {
      renamed.push_back(named.kind(proper_symbol(letters)));
    }
  }
  for (std::uint32_t& kind : atoms.kinds) kind = renamed[kind];
  atoms.move_names_from(std::move(named));
  name_elements(atoms);
}

// Checks that a frame is followed by the end of the file or by the next frame's number of atoms. In
// files of the data set QM9, three other lines follow: frequencies, SMILES and InChI.
void check_end_of_frame(LineReader& reader) {
  if (reader.at_end()) return;
  const std::string_view line = reader.require("a frame");
  if (parse_number<std::uint64_t>(trimmed(line))) return;
  const int number = reader.line();
  const auto smiles = reader.next();
  const auto inchi = reader.next();
  if (smiles && inchi && inchi->starts_with("InChI=") && reader.at_end()) return;
  reader.reject_at(
      number,
      fmt::format("expected the end of the file or the next frame's number of "
                  "atoms, found '{}'; the frame has more lines than its number of atoms requires",
                  quotable(trimmed(line))));
}

}  // namespace

ParticleSet read_xyz(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  std::vector<std::string_view> words;
  for (std::uint64_t current = 0;; ++current) {
    if (current > 0 && reader.at_end()) {
      reader.reject(fmt::format(
          "there is no frame {}; number of frames in the file: {} (the first is frame 0)", frame,
          current));
    }
    const std::uint64_t count =
        reader.count(reader.require("the number of atoms"), "the number of atoms");
    const std::string atoms_wanted = fmt::format("{} atoms", count);
    const std::string_view comment = reader.require("a comment");
    if (current < frame) {
      reader.skip(count, atoms_wanted);
      continue;
    }
    const XyzColumns columns = columns_of(comment, reader);
    Atoms atoms;
    atoms.places.reserve(reader.reservation(count, 8));
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::string_view line = reader.require(atoms_wanted);
      if (columns.count) {
        split_quoted_into(line, words, reader);
      } else {
        split_words_into(line, words);
      }
      add_xyz_atom(atoms, words, columns, reader);
    }
    if (atoms.places.empty()) reader.reject("expected atoms, found none");
    if (const auto more = reader.count_frames(0, 1)) atoms.frames = current + 1 + *more;
    check_end_of_frame(reader);
    name_words(atoms, columns.numbered);
    return to_particles(std::move(atoms), colour, reader);
  }
}

}  // namespace triptych::scene
