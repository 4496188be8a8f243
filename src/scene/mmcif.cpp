#include "scene/mmcif.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scene/elements.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view category = "_atom_site.";

struct Token {
  std::string_view text;
  bool quoted = false;  // a value whatever it looks like

  [[nodiscard]] bool is_tag() const { return !quoted && text.starts_with('_'); }
  // loop_, data_NAME, save_NAME, global_, stop_: what ends a loop.
  [[nodiscard]] bool is_keyword() const {
    if (quoted) return false;
    const std::string word = lower_case(text.substr(0, 8));
    return word == "loop_" || word.starts_with("data_") || word.starts_with("save_") ||
           word == "global_" || word == "stop_";
  }
  [[nodiscard]] bool is_value() const { return !is_tag() && !is_keyword(); }
};

// The words of a CIF: quoted words, text fields between lines that begin with a semicolon, comments
// left out. A text field's own content is of no use here and is dropped.
class Tokens {
 public:
  explicit Tokens(LineReader& reader) : reader_(reader) {}

  // The next word without taking it; nothing at the end of the file.
  [[nodiscard]] const std::optional<Token>& peek() {
    if (!ahead_ && !ended_) ahead_ = read();
    return ahead_;
  }
  void take() { ahead_.reset(); }
  // Whether a line that begins with '#' came before the word, or the end, that was last seen.
  [[nodiscard]] bool after_mark() const { return marks_ > 0; }
  // Whether just one did, and said nothing.
  [[nodiscard]] bool after_lone_mark() const { return marks_ == 1 && bare_mark_; }

 private:
  std::optional<Token> read() {
    marks_ = 0;
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
        bare_mark_ = trimmed(rest_) == "#";
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
      // A quote ends a word only where a blank follows: 'O5'' is one word.
      end = rest_.find(first, 1);
      while (end != std::string_view::npos && end + 1 < rest_.size() && rest_[end + 1] != ' ' &&
             rest_[end + 1] != '\t') {
        end = rest_.find(first, end + 1);
      }
      if (end == std::string_view::npos)
        reader_.reject(fmt::format("expected a closing {}", first));
    } else {
      end = std::min(rest_.find_first_of(" \t"), rest_.size());
    }
    const std::size_t skipped = quoted ? 1 : 0;
    const Token token{rest_.substr(skipped, end - skipped), quoted};
    rest_.remove_prefix(end + skipped);
    return token;
  }

  LineReader& reader_;
  std::string_view rest_;  // of the current line
  std::optional<Token> ahead_;
  bool ended_ = false;
  int marks_ = 0;
  bool bare_mark_ = false;  // the last of them
};

// Where the columns that matter stand in a row.
struct Columns {
  std::size_t count = 0;
  std::optional<std::size_t> element, x, y, z, model;
};

std::size_t require_column(const std::optional<std::size_t>& column, std::string_view name,
                           const LineReader& reader) {
  if (!column) reader.reject(fmt::format("expected a column {}{}", category, name));
  return *column;
}

// The tags of a loop, whose keyword is taken; nothing where it is not the loop over atoms.
std::optional<Columns> read_columns(Tokens& tokens) {
  Columns columns;
  bool atoms = false;
  for (; tokens.peek() && tokens.peek()->is_tag(); tokens.take()) {
    const std::string tag = lower_case(tokens.peek()->text);
    const std::size_t index = columns.count++;
    if (!tag.starts_with(category)) continue;
    atoms = true;
    const std::string_view name = std::string_view(tag).substr(category.size());
    if (name == "type_symbol") columns.element = index;
    if (name == "cartn_x") columns.x = index;
    if (name == "cartn_y") columns.y = index;
    if (name == "cartn_z") columns.z = index;
    if (name == "pdbx_pdb_model_num") columns.model = index;
  }
  if (!atoms) return std::nullopt;
  return columns;
}

// Counts the models as they come: rows of one model stand together.
class Models {
 public:
  std::uint64_t index_of(std::string_view name) {
    if (count_ == 0 || name != current_) {
      current_ = name;
      ++count_;
    }
    return count_ - 1;
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  std::string_view current_;
  std::uint64_t count_ = 0;
};

ParticleSet read_rows(Tokens& tokens, const Columns& columns, std::uint64_t frame,
                      ColourKind colour, const LineReader& reader) {
  const std::size_t element = require_column(columns.element, "type_symbol", reader);
  const std::size_t x = require_column(columns.x, "Cartn_x", reader);
  const std::size_t y = require_column(columns.y, "Cartn_y", reader);
  const std::size_t z = require_column(columns.z, "Cartn_z", reader);
  Atoms atoms;
  Models models;
  std::vector<std::string_view> row;
  while (tokens.peek() && tokens.peek()->is_value()) {
    row.clear();
    for (; row.size() < columns.count; tokens.take()) {
      if (!tokens.peek() || !tokens.peek()->is_value()) {
        reader.reject(fmt::format("expected {} values in each row of {}, found {} in the last one",
                                  columns.count, category, row.size()));
      }
      row.push_back(tokens.peek()->text);
    }
    if (models.index_of(columns.model ? row[*columns.model] : "") != frame) continue;
    atoms.add({reader.number(row[x], "Cartn_x"), reader.number(row[y], "Cartn_y"),
               reader.number(row[z], "Cartn_z")},
              atoms.kind(proper_symbol(row[element])));
  }
  if (models.count() == 0) reader.reject(fmt::format("expected rows of {}, found none", category));
  if (frame >= models.count()) {
    reader.reject(fmt::format("there is no frame {}; the file has {}", frame, models.count()));
  }
  return to_particles(std::move(atoms), colour, reader);
}

}  // namespace

ParticleSet read_mmcif(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  Tokens tokens(reader);
  bool closes_parts = false;
  while (tokens.peek()) {
    const std::string word = tokens.peek()->is_keyword() ? lower_case(tokens.peek()->text) : "";
    tokens.take();
    // Whoever closes the heading with '#' closes every part; others only put it before each, or
    // say there who they are.
    if (word.starts_with("data_")) closes_parts = tokens.peek() && tokens.after_lone_mark();
    if (word != "loop_") continue;
    if (const auto columns = read_columns(tokens)) {
      ParticleSet set = read_rows(tokens, *columns, frame, colour, reader);
      if (closes_parts && !tokens.peek() && !tokens.after_mark()) {
        reader.reject("the file ends here, where '#' was expected");
      }
      return set;
    }
  }
  reader.reject(fmt::format("expected a loop over {}, found none", category));
}

}  // namespace triptych::scene
