#include "scene/pdb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "scene/element_names.hpp"
#include "scene/elements.hpp"

namespace triptych::scene {
namespace {

constexpr std::size_t end_of_place = 54;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter_of_pdb(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

// Returns the columns `first` to `last` of a line. As in the specification, columns are 1-based and
// the range includes both ends.
std::string_view columns(std::string_view line, std::size_t first, std::size_t last) {
  return line.size() < first ? std::string_view{} : line.substr(first - 1, last - first + 1);
}

bool is_blank_column(std::string_view line, std::size_t column) {
  return line.size() < column || line[column - 1] == ' ';
}

// Returns the letters of an atom's name, without preceding digits.
std::string letters_of_name(std::string_view name) {
  std::string letters = lower_case(trimmed(name));
  letters.erase(0, letters.find_first_not_of("0123456789'\" "));
  return letters;
}

// Returns the symbol in columns 77 and 78, or an empty string if there is none. Older files have
// other text in these columns. For example, the "RA" of the segment name "MEMBRANE" does not mean
// radium.
std::string symbol_in_columns(std::string_view line) {
  const std::string_view field = columns(line, 77, 78);
  const std::string_view symbol = trimmed(field);
  if (!atomic_number(symbol)) return {};
  const bool within_a_word =
      line.size() >= 76 && is_letter_of_pdb(line[75]) && field.front() != ' ';
  if (within_a_word && !letters_of_name(columns(line, 13, 16)).starts_with(lower_case(symbol))) {
    return {};
  }
  return proper_symbol(symbol);
}

std::uint32_t kind_of_atom(Atoms& atoms, std::string_view line) {
  const std::string symbol = symbol_in_columns(line);
  if (!symbol.empty()) return atoms.kind(symbol);
  // CHARMM's residue names have four letters, the last of which is in column 21.
  return unnamed_kind(atoms, columns(line, 13, 16), columns(line, 18, 21));
}

// Reads a coordinate, which has the format Real(8.3). A number that is too wide overlaps the
// neighbouring columns, where it may look like a different number. Therefore a number in any other
// format must be surrounded by blanks.
double coordinate(std::string_view line, std::size_t first, std::string_view what,
                  const LineReader& reader) {
  const std::size_t last = first + 7;
  const std::string_view field = columns(line, first, last);
  const double value = reader.number(field, what);
  const bool as_specified =
      field[4] == '.' && is_digit(field[5]) && is_digit(field[6]) && is_digit(field[7]);
  const bool after_a_number = first > 31;
  const bool begins = is_blank_column(line, first - 1) || (after_a_number && field[0] == ' ');
  const bool is_alone = begins && is_blank_column(line, last + 1);
  if (after_a_number ? !as_specified && !is_alone : !begins || (!as_specified && !is_alone)) {
    reader.reject(
        fmt::format("{}: '{}' is not separated from the adjacent columns; numbers wider than "
                    "their columns are not supported",
                    what, quotable(trimmed(field))));
  }
  return value;
}

void add_pdb_atom(Atoms& atoms, std::string_view line, const LineReader& reader) {
  if (line.substr(0, end_of_place).find('\t') != std::string_view::npos) {
    reader.reject("the atom record contains tabs; expected fixed-width columns padded with blanks");
  }
  if (line.size() < end_of_place) {
    reader.reject(
        fmt::format("expected an atom with its position in columns 31 to 54, found {} columns{}",
                    line.size(), reader.truncation_hint()));
  }
  const std::array<double, 3> place{coordinate(line, 31, "x in columns 31 to 38", reader),
                                    coordinate(line, 39, "y in columns 39 to 46", reader),
                                    coordinate(line, 47, "z in columns 47 to 54", reader)};
  atoms.add(place, kind_of_atom(atoms, line));
}

// Returns whether a line describes an atom. A six-digit serial number may begin in column 5 or 6.
// Throws for a line that looks like an atom but is not valid, because otherwise this atom would be
// missing without notice.
bool is_atom(std::string_view line, const LineReader& reader) {
  if (line.starts_with("HETATM")) return true;
  if (line.starts_with("ATOM")) {
    const std::string_view rest = columns(line, 5, 6);
    if (rest.find_first_not_of(" 0123456789") == std::string_view::npos) return true;
  }
  const std::string_view text = trimmed(line);
  const std::string word = lower_case(text.substr(0, 7));
  for (const std::string_view name : {"atom", "hetatm"}) {
    if (!word.starts_with(name)) continue;
    if (text.size() > name.size() && is_letter_of_pdb(text[name.size()])) continue;
    reader.reject(
        fmt::format("'{}' looks like an atom; expected ATOM or HETATM in capitals, starting in "
                    "column 1 and followed by blanks or digits",
                    quotable(text.substr(0, 12))));
  }
  return false;
}

// Determines where frames begin and end. A frame is a model. In files without MODEL records, a
// frame ends with END or ENDMDL, as written by VMD.
class PdbFrames {
 public:
  explicit PdbFrames(const LineReader& reader) : reader_(reader) {}

  // Must be called once for each atom. Returns the index of the atom's frame.
  std::uint64_t atom() {
    if (has_models_ && !in_model_) reader_.reject("expected a MODEL record before further atoms");
    if (!in_model_ && (count_ == 0 || closed_)) ++count_;
    closed_ = false;
    return count_ - 1;
  }

  void record(std::string_view name, std::string_view line) {
    if (name == "MODEL") {
      begin_model();
    } else if (name == "ENDMDL" || name == "END") {
      in_model_ = false;
      closed_ = true;
    } else if (name == "HEADER") {
      // In entries of the PDB itself, these columns contain the id of the entry.
      is_entry_ = !trimmed(columns(line, 63, 66)).empty();
    }
    if (name == "END") ended_ = true;
  }

  void finish() const {
    if (in_model_) reader_.reject("unexpected end of file; expected ENDMDL");
    const bool cut_off = (is_entry_ && !ended_) || (count_ > 1 && !closed_);
    if (cut_off) reader_.reject("unexpected end of file; expected END");
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  void begin_model() {
    if (in_model_) reader_.reject("expected ENDMDL before the next MODEL");
    if (count_ > 0 && !has_models_) {
      reader_.reject("a MODEL record is not allowed after atoms that do not belong to a model");
    }
    has_models_ = in_model_ = true;
    ++count_;
  }

  const LineReader& reader_;
  std::uint64_t count_ = 0;  // number of frames that have begun
  bool has_models_ = false;
  bool in_model_ = false;
  bool closed_ = false;    // whether the most recent frame has ended
  bool ended_ = false;     // whether there was an END record
  bool is_entry_ = false;  // whether the file is an entry from the PDB
};

}  // namespace

ParticleSet read_pdb(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  Atoms atoms;
  PdbFrames frames(reader);
  while (const auto line = reader.next()) {
    if (is_atom(*line, reader)) {
      if (frames.atom() == frame) add_pdb_atom(atoms, *line, reader);
    } else {
      frames.record(trimmed(columns(*line, 1, 6)), *line);
    }
  }
  frames.finish();
  if (frame > 0 && frame >= frames.count()) {
    reader.reject(
        fmt::format("there is no frame {}; number of frames in the file: {} (the first is frame 0)",
                    frame, std::max<std::uint64_t>(frames.count(), 1)));
  }
  if (atoms.places.empty()) reader.reject("expected ATOM or HETATM records, found none");
  atoms.frames = frames.count();
  name_elements(atoms, true);
  return to_particles(std::move(atoms), colour, reader);
}

}  // namespace triptych::scene
