#include "scene/xyz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "scene/elements.hpp"

namespace triptych::scene {
namespace {

// A symbol, with or without a number after it ("C", "C12"), or an atomic number.
std::string element_of(std::string_view word, const LineReader& reader) {
  if (const auto number = parse_number<int>(word)) {
    const auto symbol = symbol_of(*number);
    if (!symbol) reader.reject(fmt::format("expected an element, found '{}'", quotable(word)));
    return std::string(*symbol);
  }
  const std::string_view letters = word.substr(0, word.find_first_of("0123456789_-+."));
  if (letters.empty())
    reader.reject(fmt::format("expected an element, found '{}'", quotable(word)));
  return proper_symbol(letters);
}

// Which words of a line say what.
struct Columns {
  std::size_t element = 0;
  std::size_t place = 1;
  std::optional<std::size_t> count;  // as stated; a plain file may have more than are of use
};

// The value of `Properties` among the comment's KEY=VALUE, in quotes or not.
std::optional<std::string_view> properties_in(std::string_view comment) {
  constexpr std::string_view key = "properties=";
  constexpr std::string_view quotes = "\"'";
  for (std::size_t i = 0; i < comment.size(); ++i) {
    const char before = i == 0 ? ' ' : comment[i - 1];
    const bool begins = before == ' ' || before == '\t';
    if (begins && lower_case(comment.substr(i, key.size())) == key) {
      const std::string_view value = comment.substr(i + key.size());
      const bool quoted = quotes.find(value.substr(0, 1)) != std::string_view::npos;
      if (value.empty() || !quoted) return value.substr(0, value.find_first_of(" \t"));
      return value.substr(1, value.find(value.front(), 1) - 1);
    }
    // Past a value in quotes; an apostrophe within a word is none.
    if (!(begins || before == '=') || quotes.find(comment[i]) == std::string_view::npos) continue;
    const std::size_t end = comment.find(comment[i], i + 1);
    if (end != std::string_view::npos) i = end;
  }
  return std::nullopt;
}

std::string_view take_word(std::string_view& list) {
  const std::size_t end = std::min(list.find(':'), list.size());
  const std::string_view word = list.substr(0, end);
  list.remove_prefix(std::min(end + 1, list.size()));
  return word;
}

// Of NAME:TYPE:COUNT:…, in the order of the columns.
Columns stated_columns(std::string_view list, const LineReader& reader) {
  constexpr std::size_t most_columns = 10'000;
  std::optional<std::size_t> element;
  std::optional<std::size_t> place;
  std::size_t count = 0;
  do {
    const std::string_view name = take_word(list);
    static_cast<void>(take_word(list));
    const std::string_view word = take_word(list);
    const auto columns = parse_number<std::size_t>(word);
    if (!columns || *columns == 0 || *columns > most_columns) {
      reader.reject(fmt::format("expected Properties=NAME:TYPE:COUNT:…, found the count '{}'",
                                quotable(word)));
    }
    if (name == "species" && *columns == 1) element = count;
    if (name == "pos" && *columns == 3) place = count;
    count += *columns;
  } while (!list.empty());
  if (!element || !place) {
    reader.reject("expected Properties with species (1 column) and pos (3)");
  }
  return {.element = *element, .place = *place, .count = count};
}

void add_atom(Atoms& atoms, const std::vector<std::string_view>& words, const Columns& columns,
              const LineReader& reader) {
  if (!columns.count && words.size() < 4) reader.reject("expected an element, x, y and z");
  if (columns.count && words.size() != *columns.count) {
    reader.reject(fmt::format("expected {} columns, as Properties says, found {}", *columns.count,
                              words.size()));
  }
  atoms.add({reader.number(words[columns.place], "x"), reader.number(words[columns.place + 1], "y"),
             reader.number(words[columns.place + 2], "z")},
            atoms.kind(element_of(words[columns.element], reader)));
}

}  // namespace

ParticleSet read_xyz(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  std::vector<std::string_view> words;
  for (std::uint64_t current = 0;; ++current) {
    if (current > 0 && reader.at_end()) {
      reader.reject(fmt::format("there is no frame {}; the file has {}", frame, current));
    }
    const std::uint64_t count =
        reader.count(reader.require("the number of atoms"), "the number of atoms");
    const std::string atoms_wanted = fmt::format("the last of {} atoms", count);
    const std::string_view comment = reader.require("a comment");
    if (current < frame) {
      reader.skip(count, atoms_wanted);
      continue;
    }
    const auto properties = properties_in(comment);
    const Columns columns = properties ? stated_columns(*properties, reader) : Columns{};
    Atoms atoms;
    atoms.places.reserve(reader.room(count, 8));
    for (std::uint64_t i = 0; i < count; ++i) {
      split_words_into(reader.require(atoms_wanted), words);
      add_atom(atoms, words, columns, reader);
    }
    if (atoms.places.empty()) reader.reject("expected atoms, found none");
    // What follows must be another frame: else the count was too small.
    if (!reader.at_end()) {
      static_cast<void>(
          reader.count(reader.require("a frame"), "the next frame's number of atoms"));
    }
    return to_particles(std::move(atoms), colour, reader);
  }
}

}  // namespace triptych::scene
