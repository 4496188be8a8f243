#include "scene/gro.hpp"

#include <fmt/format.h>

#include <array>

#include "scene/elements.hpp"

namespace triptych::scene {
namespace {

constexpr double nanometre = 0.1;  // an ångström in this file's unit
constexpr std::size_t places_begin = 20;

// How wide the columns of a place are: the distance between its decimal points, which tells the
// number of decimals that the file was written with.
std::size_t place_width(std::string_view line, const LineReader& reader) {
  const std::size_t first = line.find('.', places_begin);
  const std::size_t second = first == std::string_view::npos ? first : line.find('.', first + 1);
  if (second == std::string_view::npos) {
    reader.reject("expected x, y and z with decimal points from column 21 on");
  }
  return second - first;
}

void add_atom(Atoms& atoms, std::string_view line, std::size_t width, const LineReader& reader) {
  if (line.size() < places_begin + 3 * width) {
    reader.reject(
        fmt::format("expected an atom with its place in columns 21 to {}, found {} columns",
                    places_begin + 3 * width, line.size()));
  }
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  std::array<double, 3> place{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place.at(axis) = reader.number(line.substr(places_begin + axis * width, width), axes.at(axis));
  }
  const std::string element =
      element_from_name(trimmed(line.substr(10, 5)), trimmed(line.substr(5, 5)));
  atoms.add(place, atoms.kind(element));
}

void check_box(std::string_view line, const LineReader& reader) {
  const auto words = split_words(line);
  if (words.size() != 3 && words.size() != 9) {
    reader.reject("expected the box, 3 or 9 numbers, after the last atom");
  }
  for (const std::string_view word : words) static_cast<void>(reader.number(word, "box"));
}

}  // namespace

ParticleSet read_gro(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  for (std::uint64_t current = 0;; ++current) {
    if (current > 0 && reader.at_end()) {
      reader.reject(fmt::format("there is no frame {}; the file has {}", frame, current));
    }
    static_cast<void>(reader.require("a title"));
    const std::uint64_t count =
        reader.count(reader.require("the number of atoms"), "the number of atoms");
    const std::string atoms_wanted = fmt::format("the last of {} atoms", count);
    if (current < frame) {
      reader.skip(count, atoms_wanted);
      check_box(reader.require("the box"), reader);
      continue;
    }
    Atoms atoms;
    atoms.angstrom = nanometre;
    atoms.places.reserve(reader.room(count, places_begin));
    std::size_t width = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::string_view line = reader.require(atoms_wanted);
      if (i == 0) width = place_width(line, reader);
      add_atom(atoms, line, width, reader);
    }
    check_box(reader.require("the box"), reader);
    if (atoms.places.empty()) reader.reject("expected atoms, found none");
    return to_particles(std::move(atoms), colour, reader);
  }
}

}  // namespace triptych::scene
