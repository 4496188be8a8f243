#include "scene/xyz.hpp"

#include <fmt/format.h>

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
    static_cast<void>(reader.require("a comment"));
    if (current < frame) {
      reader.skip(count, atoms_wanted);
      continue;
    }
    Atoms atoms;
    atoms.places.reserve(reader.room(count, 8));
    for (std::uint64_t i = 0; i < count; ++i) {
      split_words_into(reader.require(atoms_wanted), words);
      if (words.size() < 4) reader.reject("expected an element, x, y and z");
      atoms.add({reader.number(words[1], "x"), reader.number(words[2], "y"),
                 reader.number(words[3], "z")},
                atoms.kind(element_of(words[0], reader)));
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
