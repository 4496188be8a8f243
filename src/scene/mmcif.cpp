#include "scene/mmcif.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "scene/element_names.hpp"
#include "scene/elements.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view category = "_atom_site.";

struct Token {
  std::string_view text;
  bool quoted = false;  // quoted words are always values

  [[nodiscard]] bool is_tag() const { return !quoted && text.starts_with('_'); }
  // Returns whether this word ends a loop: loop_, data_NAME, save_NAME, global_ and stop_ do.
  [[nodiscard]] bool is_keyword() const {
    if (quoted) return false;
    const std::string word = lower_case(text.substr(0, 8));
    return word == "loop_" || word.starts_with("data_") || word.starts_with("save_") ||
           word == "global_" || word == "stop_";
  }
  [[nodiscard]] bool is_value() const { return !is_tag() && !is_keyword(); }
};

// Splits a CIF file into words: plain words, quoted words, and text fields. A text field is
// enclosed by lines that begin with a semicolon. Its content is not needed, so it is discarded.
// Comments are skipped.
class Tokens {
 public:
  explicit Tokens(LineReader& reader) : reader_(reader) {}

  // Returns the next word without consuming it, or nullopt at the end of the file.
  [[nodiscard]] const std::optional<Token>& peek() {
    if (!ahead_ && !ended_) ahead_ = read();
    return ahead_;
  }
  void take() { ahead_.reset(); }
  // Return the number of lines that begin with '#' before the current word (or before the end of
  // the file). marks() counts all of these lines, and marks_before() only those directly before the
  // word.
  [[nodiscard]] std::uint64_t marks() const { return marks_; }
  [[nodiscard]] std::uint64_t marks_before() const { return marks_before_; }

 private:
  std::optional<Token> read() {
    marks_before_ = 0;
    for (;;) {
      const std::size_t begin = rest_.find_first_not_of(" \t");
      if (begin != std::string_view::npos && rest_[begin] != '#') {
        rest_.remove_prefix(begin);
        return word();
      }
      const auto line = reader_.next();
      if (!line) {
        ended_ = true;
        return std::nullopt;
      }
      rest_ = *line;
      if (rest_.starts_with('#')) {
        ++marks_;
        ++marks_before_;
      }
      if (rest_.starts_with(';')) return text_field();
    }
  }

  Token text_field() {
    do {
      rest_ = reader_.require("the ';' that ends a text field");
    } while (!rest_.starts_with(';'));
    rest_.remove_prefix(1);
    return {.text = {}, .quoted = true};
  }

  Token word() {
    const char first = rest_.front();
    const bool quoted = first == '\'' || first == '"';
    std::size_t end = 0;
    if (quoted) {
      // A quote ends a word only if a blank follows, so 'O5'' is a single word.
      end = rest_.find(first, 1);
      while (end != std::string_view::npos && end + 1 < rest_.size() && rest_[end + 1] != ' ' &&
             rest_[end + 1] != '\t') {
        end = rest_.find(first, end + 1);
      }
      if (end == std::string_view::npos)
        reader_.reject(fmt::format("expected a closing quote ({})", first));
    } else {
      end = std::min(rest_.find_first_of(" \t"), rest_.size());
    }
    const std::size_t skipped = quoted ? 1 : 0;
    const Token token{rest_.substr(skipped, end - skipped), quoted};
    rest_.remove_prefix(end + skipped);
    return token;
  }

  LineReader& reader_;
  std::string_view rest_;  // rest of the current line
  std::optional<Token> ahead_;
  bool ended_ = false;
  std::uint64_t marks_ = 0;
  std::uint64_t marks_before_ = 0;
};

// The columns of _atom_site that the reader uses. Several of them may be missing.
enum class Item : std::uint8_t { element, x, y, z, model, atom, residue, old_atom, old_residue };
constexpr std::array<std::string_view, 9> item_names{
    "type_symbol",   "cartn_x",       "cartn_y",      "cartn_z",     "pdbx_pdb_model_num",
    "label_atom_id", "label_comp_id", "auth_atom_id", "auth_comp_id"};

struct AtomColumns {
  std::size_t count = 0;
  std::array<std::optional<std::size_t>, item_names.size()> places;

  [[nodiscard]] const std::optional<std::size_t>& operator[](Item item) const {
    return places.at(static_cast<std::size_t>(item));
  }
  // Adds a column by its tag, which must be in lower case.
  void add(std::string_view tag, const LineReader& reader) {
    const std::size_t index = count++;
    if (!tag.starts_with(category)) return;
    const auto found = std::ranges::find(item_names, tag.substr(category.size()));
    if (found == item_names.end()) return;
    auto& place = places.at(static_cast<std::size_t>(found - item_names.begin()));
    if (place) reader.reject(fmt::format("'{}' appears twice", tag));
    place = index;
  }
};

// CIF files of small molecules use other items, which state positions as fractions of the unit
// cell.
void refuse_small_molecule(std::string_view tag, const LineReader& reader) {
  if (tag != "_atom_site_fract_x") return;
  reader.reject(
      "the file contains fractional coordinates (_atom_site_fract_x), as is usual for "
      "small-molecule CIF files; expected mmCIF with _atom_site.Cartn_x; to convert: obabel "
      "IN.cif -O OUT.xyz");
}

// Reads the tags of a loop whose keyword has been read. Returns nullopt if it is not the loop over
// atoms.
std::optional<AtomColumns> read_columns(Tokens& tokens, const LineReader& reader) {
  AtomColumns columns;
  bool atoms = false;
  for (; tokens.peek() && tokens.peek()->is_tag(); tokens.take()) {
    const std::string tag = lower_case(tokens.peek()->text);
    refuse_small_molecule(tag, reader);
    atoms |= tag.starts_with(category);
    columns.add(tag, reader);
  }
  if (!atoms) return std::nullopt;
  return columns;
}

// Collects the rows of one model. The rows of a model need not be consecutive, so frames are
// numbered in the order in which the models first appear.
class AtomRows {
 public:
  AtomRows(const AtomColumns& columns, std::uint64_t frame, const LineReader& reader)
      : columns_(columns), frame_(frame), reader_(reader) {
    constexpr std::array<std::string_view, 3> names{"Cartn_x", "Cartn_y", "Cartn_z"};
    constexpr std::array<Item, 3> items{Item::x, Item::y, Item::z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place_.at(axis) = require(items.at(axis), names.at(axis));
    }
    atom_ = columns[Item::atom] ? columns[Item::atom] : columns[Item::old_atom];
    residue_ = columns[Item::residue] ? columns[Item::residue] : columns[Item::old_residue];
    if (!atom_) static_cast<void>(require(Item::element, "type_symbol"));
  }

  void add(const std::vector<std::string_view>& row) {
    const auto& model = columns_[Item::model];
    if (index_of(model ? row[*model] : std::string_view{}) != frame_) return;
    constexpr std::array<std::string_view, 3> names{"Cartn_x", "Cartn_y", "Cartn_z"};
    std::array<double, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place.at(axis) = reader_.number(without_uncertainty(row[place_.at(axis)]), names.at(axis));
    }
    atoms_.add(place, kind_of(row));
  }

  [[nodiscard]] Atoms take() {
    if (models_.empty()) {
      reader_.reject(fmt::format("expected rows of {}*, found none", category));
    }
    if (frame_ >= models_.size()) {
      reader_.reject(fmt::format(
          "there is no frame {}; number of frames in the file: {} (the first is frame 0)", frame_,
          models_.size()));
    }
    atoms_.frames = models_.size();
    name_elements(atoms_);
    return std::move(atoms_);
  }

 private:
  std::size_t require(Item item, std::string_view name) const {
    const auto& column = columns_[item];
    if (!column) reader_.reject(fmt::format("the column {}{} is missing", category, name));
    return *column;
  }

  // Removes the uncertainty, which a number such as "1.234(5)" contains in parentheses.
  static std::string_view without_uncertainty(std::string_view word) {
    return word.ends_with(')') ? word.substr(0, word.find('(')) : word;
  }

  std::uint32_t kind_of(const std::vector<std::string_view>& row) {
    const auto& element = columns_[Item::element];
    const std::string_view symbol = element ? row[*element] : std::string_view("?");
    const bool unstated = symbol.empty() || symbol == "?" || symbol == ".";
    if (!unstated) {
      // The symbol may be followed by a charge, as in "Fe3+".
      return atoms_.kind(proper_symbol(symbol.substr(0, symbol.find_first_of("0123456789+-"))));
    }
    if (!atom_) return atoms_.kind(unknown_element);
    return unnamed_kind(atoms_, row[*atom_], residue_ ? row[*residue_] : std::string_view{});
  }

  std::size_t index_of(std::string_view model) {
    if (model == last_ && !models_.empty()) return last_index_;
    last_ = model;
    last_index_ = models_.try_emplace(std::string(model), models_.size()).first->second;
    return last_index_;
  }

  const AtomColumns& columns_;
  std::uint64_t frame_;
  const LineReader& reader_;
  std::array<std::size_t, 3> place_{};
  std::optional<std::size_t> atom_;
  std::optional<std::size_t> residue_;
  std::map<std::string, std::size_t> models_;
  std::string_view last_;
  std::size_t last_index_ = 0;
  Atoms atoms_;
};

Atoms read_rows(Tokens& tokens, const AtomColumns& columns, std::uint64_t frame,
                const LineReader& reader) {
  AtomRows rows(columns, frame, reader);
  std::vector<std::string_view> row;
  while (tokens.peek() && tokens.peek()->is_value()) {
    row.clear();
    for (; row.size() < columns.count; tokens.take()) {
      if (!tokens.peek() || !tokens.peek()->is_value()) {
        reader.reject(fmt::format("expected {} values in each row of {}*, found {} in the last row",
                                  columns.count, category, row.size()));
      }
      row.push_back(tokens.peek()->text);
    }
    rows.add(row);
  }
  return rows.take();
}

// Reads a single atom whose items are tags with one value each. CIF allows this form instead of a
// loop with one row. The first tag has not been read yet.
Atoms read_pairs(Tokens& tokens, std::uint64_t frame, const LineReader& reader) {
  AtomColumns columns;
  std::vector<std::string_view> row;
  while (tokens.peek() && tokens.peek()->is_tag()) {
    const std::string tag = lower_case(tokens.peek()->text);
    if (!tag.starts_with(category)) break;
    columns.add(tag, reader);
    tokens.take();
    if (!tokens.peek() || !tokens.peek()->is_value()) {
      reader.reject(fmt::format("expected a value after {}", tag));
    }
    row.push_back(tokens.peek()->text);
    tokens.take();
  }
  AtomRows rows(columns, frame, reader);
  rows.add(row);
  return rows.take();
}

// Detects truncated files. Some programs, such as those of the PDB, end the heading and every
// category with a line '#'. If a file does so before the atoms, but the category of the atoms is
// the last one and has no final '#', the file is probably truncated. The reader rejects such a file
// if there are at least `conclusive_marks` lines '#' between the heading and the atoms. If there
// are fewer, it only adds a note, because some programs write '#' only between categories.
class ClosingMarks {
 public:
  void heading(const Tokens& tokens) {
    closes_heading_ = tokens.marks_before() == 1;
    at_heading_ = tokens.marks();
  }
  void atoms_follow(const Tokens& tokens) { closed_ = tokens.marks() - at_heading_; }
  void atoms_end(Tokens& tokens, Atoms& atoms, const LineReader& reader) const {
    if (tokens.peek() || tokens.marks_before() > 0 || !closes_heading_ || closed_ == 0) return;
    if (closed_ >= conclusive_marks) reader.reject("unexpected end of file; expected '#'");
    atoms.notes.emplace_back(
        "other sections of the file end with '#', but the atom section does not; the file may be "
        "truncated, so atoms may be missing");
  }

 private:
  static constexpr std::uint64_t conclusive_marks = 3;
  bool closes_heading_ = false;
  std::uint64_t at_heading_ = 0;
  std::uint64_t closed_ = 0;
};

// Describes the content of a file without atoms, if the tag of one of its loops reveals the
// content. Otherwise returns an empty string.
std::string_view other_content(std::string_view tag) {
  if (tag.starts_with("_chem_comp_atom.")) {
    return "the file describes a chemical component (_chem_comp_atom), not a structure";
  }
  if (tag.starts_with("_refln")) return "the file contains reflections (_refln), not a structure";
  return {};
}

}  // namespace

ParticleSet read_mmcif(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  Tokens tokens(reader);
  std::optional<Atoms> atoms;
  ClosingMarks marks;
  std::uint64_t further_blocks = 0;
  std::string_view other;
  while (tokens.peek()) {
    const Token token = *tokens.peek();
    constexpr std::size_t longest_keyword = 20;
    const std::string word = lower_case(token.text.substr(0, longest_keyword));
    if (token.is_tag() && word.starts_with(category)) {
      if (atoms) {
        ++further_blocks;
        tokens.take();
        continue;
      }
      atoms = read_pairs(tokens, frame, reader);
      continue;
    }
    const bool is_heading = token.is_keyword() && word.starts_with("data_");
    if (!atoms) marks.atoms_follow(tokens);
    tokens.take();
    if (is_heading && !atoms && tokens.peek()) marks.heading(tokens);
    if (!token.is_keyword() || word != "loop_" || atoms) continue;
    if (other.empty() && tokens.peek()) other = other_content(lower_case(tokens.peek()->text));
    if (const auto columns = read_columns(tokens, reader)) {
      atoms = read_rows(tokens, *columns, frame, reader);
      marks.atoms_end(tokens, *atoms, reader);
    }
  }
  if (!atoms) {
    reader.reject(fmt::format("expected a loop over {}*, found none{}{}", category,
                              other.empty() ? "" : ": ", other));
  }
  if (further_blocks > 0) {
    atoms->notes.emplace_back(
        "the file has atoms in several data blocks; only the atoms of the first block are read");
  }
  return to_particles(std::move(*atoms), colour, reader);
}

}  // namespace triptych::scene
