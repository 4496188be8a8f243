#include "scene/gro.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scene/element_names.hpp"

namespace triptych::scene {
namespace {

constexpr double nanometre = 0.1;  // the length of an ångström in nanometres, the unit of the file
constexpr std::size_t places_begin = 20;

// Returns the width of a coordinate in columns. A coordinate with n decimals is n + 5 columns wide
// and has its decimal point in the fifth column, so the first decimal point is always in column 25
// of the line, and the distance between decimal points is the width. One line is sufficient to
// determine the width, because no number may be wider than its columns.
std::size_t place_width(std::string_view line, const LineReader& reader) {
  constexpr std::size_t first_point = places_begin + 4;
  const std::size_t first = line.find('.', places_begin);
  const std::size_t second = first == std::string_view::npos ? first : line.find('.', first + 1);
  const std::size_t third = second == std::string_view::npos ? second : line.find('.', second + 1);
  if (third == std::string_view::npos) {
    reader.reject("expected x, y and z with decimal points, starting in column 21");
  }
  if (first != first_point || third - second != second - first || second - first < 6) {
    reader.reject(
        fmt::format("the decimal points of x, y and z are in columns {}, {} and {}; "
                    "expected the first point in column 25 and equally spaced points; a "
                    "coordinate may be too wide for its columns",
                    first + 1, second + 1, third + 1));
  }
  return second - first;
}

void add_gro_atom(Atoms& atoms, std::string_view line, std::size_t width,
                  const LineReader& reader) {
  if (line.size() < places_begin + 3 * width) {
    reader.reject(fmt::format(
        "expected an atom with its position in columns 21 to {}, but the line has {} columns{}",
        places_begin + 3 * width, line.size(), reader.truncation_hint()));
  }
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  std::array<double, 3> place{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view field = line.substr(places_begin + axis * width, width);
    place.at(axis) = reader.number(field, axes.at(axis));
    if (field.find('.') == 4 || !std::isfinite(place.at(axis))) continue;
    reader.reject(
        fmt::format("{}: '{}' is not aligned to columns {} to {}, which contain this "
                    "coordinate in the first atom's line; numbers wider than their "
                    "columns are not supported",
                    axes.at(axis), quotable(trimmed(field)), places_begin + axis * width + 1,
                    places_begin + (axis + 1) * width));
  }
  atoms.add(place, unnamed_kind(atoms, trimmed(line.substr(10, 5)), line.substr(5, 5)));
}

// Checks that the line describes a box and not another atom. In a box larger than 1000 nm, no
// blanks separate the numbers, so a line with three decimal points is also accepted.
void check_box(std::string_view line, const LineReader& reader) {
  const std::size_t words = split_words(line).size();
  const bool numbers = line.find_first_not_of("0123456789.+-eE \t") == std::string_view::npos;
  const bool enough = words == 3 || words == 9 || std::ranges::count(line, '.') >= 3;
  if (numbers && enough) return;
  reader.reject("expected the box (3 or 9 numbers) after the last atom");
}

// Returns the edges of the box: "xx yy zz" or "xx yy zz xy xz yx yz zx zy" (GROMACS manual, "gro").
// Returns nullopt if there is no box, which GROMACS writes as zeros, or if no blanks separate the
// numbers.
std::optional<BoxEdges> gro_box_edges(std::string_view line) {
  std::array<double, 9> v{};
  const auto words = split_words(line);
  if (words.size() != 3 && words.size() != 9) return std::nullopt;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto number = parse_number<double>(words[i]);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    v.at(i) = *number;
  }
  if (!(v[0] > 0 && v[1] > 0 && v[2] > 0)) return std::nullopt;
  return BoxEdges{{{v[0], v[3], v[4]}, {v[5], v[1], v[6]}, {v[7], v[8], v[2]}}};
}

}  // namespace

ParticleSet read_gro(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  for (std::uint64_t current = 0;; ++current) {
    if (current > 0 && reader.at_end()) {
      reader.reject(fmt::format(
          "there is no frame {}; number of frames in the file: {} (the first is frame 0)", frame,
          current));
    }
    static_cast<void>(reader.require("a title"));
    const std::uint64_t count =
        reader.count(reader.require("the number of atoms"), "the number of atoms");
    const std::string atoms_wanted = fmt::format("{} atoms", count);
    if (current < frame) {
      reader.skip(count, atoms_wanted);
      check_box(reader.require("the box"), reader);
      continue;
    }
    Atoms atoms;
    atoms.angstrom = nanometre;
    atoms.places.reserve(reader.reservation(count, places_begin));
    std::size_t width = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::string_view line = reader.require(atoms_wanted);
      if (i == 0) width = place_width(line, reader);
      add_gro_atom(atoms, line, width, reader);
    }
    const std::string_view box = reader.require("the box");
    check_box(box, reader);
    atoms.box_edges = gro_box_edges(box);
    if (const auto more = reader.count_frames(1, 1)) atoms.frames = current + 1 + *more;
    if (atoms.places.empty()) reader.reject("expected atoms, found none");
    name_elements(atoms);
    return to_particles(std::move(atoms), colour, reader);
  }
}

}  // namespace triptych::scene
