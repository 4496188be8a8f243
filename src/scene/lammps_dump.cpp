#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "scene/elements.hpp"
#include "scene/lammps.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view item_mark = "ITEM: ";
constexpr std::string_view count_item = "ITEM: NUMBER OF ATOMS";  // occurs once in each frame
using DumpWords = std::vector<std::string_view>;

// The simulation box, which is needed to convert scaled positions.
struct Cell {
  std::array<double, 3> lo{};
  std::array<double, 3> size{1, 1, 1};
  double xy = 0, xz = 0, yz = 0;

  [[nodiscard]] std::array<double, 3> place(const std::array<double, 3>& scaled) const {
    return {lo[0] + scaled[0] * size[0] + scaled[1] * xy + scaled[2] * xz,
            lo[1] + scaled[1] * size[1] + scaled[2] * yz, lo[2] + scaled[2] * size[2]};
  }
  [[nodiscard]] BoxEdges edges() const {
    return {{{size[0], 0, 0}, {xy, size[1], 0}, {xz, yz, size[2]}}};
  }
};

// The indices of the columns that the reader uses.
struct Columns {
  std::size_t count = 0;
  std::array<std::size_t, 3> place{};
  bool scaled = false;
  std::optional<std::size_t> id, type, element, radius, diameter;
};

struct Frame {
  std::optional<std::uint64_t> count;
  std::optional<Cell> cell;
};

// Reads three lines "lo hi [tilt]". For a tilted box, lo and hi are the bounds of the surrounding
// orthogonal box (LAMMPS manual, "Triclinic simulation boxes").
Cell read_cell(LineReader& reader, std::string_view header) {
  constexpr std::array<std::string_view, 3> axes{"x bounds", "y bounds", "z bounds"};
  const bool tilted = header.find("xy xz yz") != std::string_view::npos;
  if (header.find("abc origin") != std::string_view::npos) {
    reader.reject(
        "expected an orthogonal or 'xy xz yz' box; general triclinic boxes are not supported");
  }
  const std::size_t expected = tilted ? 3 : 2;
  std::array<std::array<double, 3>, 3> bounds{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto words = split_words(reader.require(axes.at(axis)));
    if (words.size() != expected) {
      reader.reject(fmt::format("{}: expected {} numbers", axes.at(axis), expected));
    }
    for (std::size_t i = 0; i < expected; ++i) {
      bounds.at(axis).at(i) = reader.number(words[i], axes.at(axis));
    }
  }
  Cell cell;
  cell.xy = bounds[0][2];
  cell.xz = bounds[1][2];
  cell.yz = bounds[2][2];
  bounds[0][0] -= std::min({0.0, cell.xy, cell.xz, cell.xy + cell.xz});
  bounds[0][1] -= std::max({0.0, cell.xy, cell.xz, cell.xy + cell.xz});
  bounds[1][0] -= std::min(0.0, cell.yz);
  bounds[1][1] -= std::max(0.0, cell.yz);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell.lo.at(axis) = bounds.at(axis)[0];
    cell.size.at(axis) = bounds.at(axis)[1] - bounds.at(axis)[0];
  }
  return cell;
}

Columns parse_columns(std::string_view header, const LineReader& reader) {
  const DumpWords names = split_words(header);
  const auto find = [&names](std::string_view name) -> std::optional<std::size_t> {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
  };
  struct Triple {
    std::array<std::string_view, 3> names;
    bool scaled;
  };
  static constexpr std::array<Triple, 4> triples{{{{"x", "y", "z"}, false},
                                                  {{"xu", "yu", "zu"}, false},
                                                  {{"xs", "ys", "zs"}, true},
                                                  {{"xsu", "ysu", "zsu"}, true}}};
  Columns columns;
  columns.count = names.size();
  columns.id = find("id");
  columns.type = find("type");
  columns.element = find("element");
  columns.radius = find("radius");
  columns.diameter = find("diameter");
  for (const Triple& triple : triples) {
    const auto x = find(triple.names[0]);
    const auto y = find(triple.names[1]);
    const auto z = find(triple.names[2]);
    if (!x || !y || !z) continue;
    columns.place = {*x, *y, *z};
    columns.scaled = triple.scaled;
    return columns;
  }
  reader.reject("expected columns x y z, xu yu zu, xs ys zs or xsu ysu zsu");
}

// Reads the headers of one frame up to its atoms. Returns the list of column names that follows
// "ITEM: ATOMS".
std::string_view read_headers(LineReader& reader, Frame& frame) {
  for (;;) {
    const std::string_view line = reader.require("ITEM: ATOMS");
    if (!line.starts_with(item_mark)) {
      reader.reject(fmt::format("expected 'ITEM: …', found '{}'", quotable(line)));
    }
    const std::string_view header = line.substr(item_mark.size());
    if (header.starts_with("ATOMS")) return header.substr(5);
    if (header.starts_with("NUMBER OF ATOMS")) {
      frame.count = reader.count(reader.require("the number of atoms"), "the number of atoms");
    } else if (header.starts_with("BOX BOUNDS")) {
      frame.cell = read_cell(reader, header);
    } else {  // TIMESTEP, TIME and UNITS have one line each
      static_cast<void>(reader.require("a value"));
    }
  }
}

class RowReader {
 public:
  RowReader(Atoms& atoms, const Columns& columns, const Cell& cell, const LineReader& reader)
      : atoms_(atoms), columns_(columns), cell_(cell), reader_(reader) {}

  void add(const DumpWords& row) {
    if (row.size() != columns_.count) {
      reader_.reject(fmt::format("expected {} values, found {}{}", columns_.count, row.size(),
                                 reader_.truncation_hint()));
    }
    constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
    std::array<double, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place.at(axis) = reader_.number(row[columns_.place.at(axis)], axes.at(axis));
    }
    atoms_.add(columns_.scaled ? cell_.place(place) : place, atoms_.kind(kind_of(row)));
    if (columns_.id) atoms_.order.push_back(reader_.integer(row[*columns_.id], "id"));
    if (columns_.radius) {
      atoms_.radii.push_back(reader_.number(row[*columns_.radius], "radius"));
    } else if (columns_.diameter) {
      atoms_.radii.push_back(reader_.number(row[*columns_.diameter], "diameter") / 2);
    }
  }

 private:
  [[nodiscard]] std::string kind_of(const DumpWords& row) const {
    if (columns_.element) return proper_symbol(row[*columns_.element]);
    return columns_.type ? std::string(row[*columns_.type]) : std::string("1");
  }

  Atoms& atoms_;
  const Columns& columns_;
  const Cell& cell_;
  const LineReader& reader_;
};

}  // namespace

ParticleSet read_lammps_dump(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  for (std::uint64_t current = 0;; ++current) {
    if (current > 0 && reader.at_end()) {
      reader.reject(fmt::format(
          "there is no frame {}; number of frames in the file: {} (the first is frame 0)", frame,
          current));
    }
    Frame header;
    const std::string_view names = read_headers(reader, header);
    if (!header.count) reader.reject("expected ITEM: NUMBER OF ATOMS before the atoms");
    const std::string atoms_wanted = fmt::format("{} atoms", *header.count);
    if (current < frame) {
      reader.skip(*header.count, atoms_wanted);
      continue;
    }
    const Columns columns = parse_columns(names, reader);
    if (columns.scaled && !header.cell) {
      reader.reject("expected ITEM: BOX BOUNDS before scaled positions");
    }
    const Cell cell = header.cell.value_or(Cell{});
    Atoms atoms;
    atoms.elements = columns.element.has_value();
    atoms.places.reserve(reader.reservation(*header.count, 2 * columns.count));
    RowReader rows(atoms, columns, cell, reader);
    const int first_line = reader.line() + 1;
    DumpWords row;
    for (std::uint64_t i = 0; i < *header.count; ++i) {
      split_words_into(reader.require(atoms_wanted), row);
      rows.add(row);
    }
    if (header.cell) atoms.box_edges = cell.edges();
    atoms.frames = current + 1 + reader.count_lines(count_item);
    if (atoms.places.empty()) reader.reject("expected atoms, found none");
    if (!reader.at_end() && !reader.require("a frame").starts_with(item_mark)) {
      reader.reject(fmt::format("expected the next frame after {} atoms", *header.count));
    }
    return to_particles(std::move(atoms), colour, reader, first_line);
  }
}

}  // namespace triptych::scene
