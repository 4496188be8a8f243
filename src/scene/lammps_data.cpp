#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "scene/lammps.hpp"

namespace triptych::scene {
namespace {

using Words = std::vector<std::string_view>;

// The columns of the type and the position in a line of the Atoms section (LAMMPS manual,
// read_data). The id is always the first column. Three image flags may follow at the end.
struct Style {
  std::string_view name;
  std::size_t type;
  std::size_t place;
  std::optional<std::size_t> diameter = std::nullopt;
  std::size_t behind = 0;  // number of columns between the position and the image flags

  [[nodiscard]] std::size_t flags() const { return place + 3 + behind; }
  [[nodiscard]] bool has_flags(std::size_t words) const { return words == flags() + 3; }
  [[nodiscard]] bool fits(std::size_t words) const { return words == flags() || has_flags(words); }
};

constexpr std::array<Style, 14> styles{{{"atomic", 1, 2},
                                        {"charge", 1, 3},
                                        {"molecular", 2, 3},
                                        {"bond", 2, 3},
                                        {"angle", 2, 3},
                                        {"full", 2, 4},
                                        {"sphere", 1, 4, 2},
                                        {"dipole", 1, 3, std::nullopt, 3},
                                        {"electron", 1, 5},
                                        {"ellipsoid", 1, 4},
                                        {"body", 1, 4},
                                        {"peri", 1, 4},
                                        {"line", 2, 5},
                                        {"tri", 2, 5}}};

std::string_view without_comment(std::string_view line) {
  return trimmed(line.substr(0, line.find('#')));
}

const Style* named_style(std::string_view comment, const LineReader& reader) {
  const std::string_view name = trimmed(comment);
  if (name.empty()) return nullptr;
  const auto found = std::ranges::find(styles, name, &Style::name);
  if (found == styles.end()) {
    reader.reject(fmt::format(
        "expected an Atoms section with the style atomic, charge, molecular, bond, angle, full, "
        "sphere, dipole, electron, ellipsoid, body, peri, line or tri; found '{}'",
        quotable(name)));
  }
  return &*found;
}

bool are_whole(const Words& words, std::size_t first) {
  return std::all_of(
      words.begin() + static_cast<std::ptrdiff_t>(first),
      words.begin() + static_cast<std::ptrdiff_t>(first) + 3,
      [](std::string_view word) { return parse_number<std::int64_t>(word).has_value(); });
}

// Determines the style from the number of columns if there is no comment. Lines with 5 columns
// always have the style atomic. Lines with 8 columns that end in image flags are atomic only if the
// position contains a decimal point. The reason is that the styles electron and line also have 8
// columns; they end with the position, which may consist of whole numbers. Lines with 6 or 7
// columns are ambiguous.
const Style& guessed_style(const Words& words, const LineReader& reader) {
  const Style& atomic = styles[0];
  if (words.size() == atomic.flags()) return atomic;
  if (atomic.has_flags(words.size()) && are_whole(words, atomic.flags())) {
    if (!are_whole(words, atomic.place)) return atomic;
    reader.reject(
        "the last 3 of the 8 columns could be image flags (style atomic) or the position (style "
        "electron or line); expected a comment that names the style, such as 'Atoms # "
        "atomic'");
  }
  reader.reject(
      fmt::format("the atom style is ambiguous for {} columns; expected a comment that names the "
                  "style, such as 'Atoms # charge' or 'Atoms # molecular'",
                  words.size()));
}

struct DataHeader {
  std::optional<std::uint64_t> count;
  std::array<std::optional<double>, 3> size;
  std::array<double, 3> tilt{};  // xy, xz, yz

  [[nodiscard]] std::optional<BoxEdges> box_edges() const {
    if (!size[0] || !size[1] || !size[2]) return std::nullopt;
    return BoxEdges{{{*size[0], 0, 0}, {tilt[0], *size[1], 0}, {tilt[1], tilt[2], *size[2]}}};
  }
};

// Reads "LOW HIGH xlo xhi" (or y, z) or "XY XZ YZ xy xz yz". The box is only printed, so a line
// that cannot be parsed is ignored.
void read_box_line(const Words& words, DataHeader& header) {
  const auto number = [&words](std::size_t i) { return parse_number<double>(words[i]); };
  constexpr std::array<std::string_view, 3> marks{"xlo", "ylo", "zlo"};
  for (std::size_t axis = 0; axis < marks.size(); ++axis) {
    if (words.size() != 4 || words[2] != marks.at(axis)) continue;
    const auto lo = number(0);
    const auto hi = number(1);
    if (lo && hi) header.size.at(axis) = *hi - *lo;
  }
  if (words.size() != 6 || words[3] != "xy") return;
  for (std::size_t i = 0; i < 3; ++i) header.tilt.at(i) = number(i).value_or(0);
}

// Reads the header up to the Atoms section, and returns the style that the section's comment names.
std::string_view find_atoms(LineReader& reader, DataHeader& header) {
  static_cast<void>(reader.require("a title"));
  for (;;) {
    const std::string_view line = reader.require("the Atoms section");
    const std::string_view text = without_comment(line);
    if (text == "Atoms") {
      const std::size_t comment = line.find('#');
      return comment == std::string_view::npos ? std::string_view{} : line.substr(comment + 1);
    }
    const Words words = split_words(text);
    if (words.size() == 2 && words[1] == "atoms") {
      header.count = reader.count(words[0], "the number of atoms");
    }
    read_box_line(words, header);
  }
}

void add_data_atom(Atoms& atoms, const Words& words, const Style& style, const LineReader& reader) {
  if (!style.fits(words.size())) {
    reader.reject(
        fmt::format("expected {} columns, or {} with image flags, for the atom style {}; found {} "
                    "columns",
                    style.flags(), style.flags() + 3, style.name, words.size()));
  }
  atoms.order.push_back(reader.integer(words[0], "id"));
  atoms.add({reader.number(words[style.place], "x"), reader.number(words[style.place + 1], "y"),
             reader.number(words[style.place + 2], "z")},
            atoms.kind(words[style.type]));
  if (style.has_flags(words.size())) {
    constexpr std::array<std::string_view, 3> names{"image flag in x", "image flag in y",
                                                    "image flag in z"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      static_cast<void>(reader.integer(words[style.flags() + i], names.at(i)));
    }
  }
  if (style.diameter) {
    atoms.radii.push_back(reader.number(words[*style.diameter], "diameter") / 2);
  }
}

}  // namespace

ParticleSet read_lammps_data(LineReader& reader, std::uint64_t frame, ColourKind colour) {
  if (frame > 0)
    reader.reject(fmt::format("there is no frame {}; a LAMMPS data file has only frame 0", frame));
  DataHeader header;
  const std::string_view comment = find_atoms(reader, header);
  const std::optional<std::uint64_t> count = header.count;
  if (!count) reader.reject("expected 'N atoms' before the Atoms section");
  if (*count == 0) reader.reject("expected atoms, found none");
  const Style* style = named_style(comment, reader);
  if (!trimmed(reader.require("a blank line")).empty()) {
    reader.reject("expected a blank line after 'Atoms'");
  }
  const std::string atoms_wanted = fmt::format("{} atoms", *count);
  const int first_line = reader.line() + 1;
  Atoms atoms;
  atoms.elements = false;
  atoms.frames = 1;
  atoms.box_edges = header.box_edges();
  atoms.places.reserve(reader.reservation(*count, 10));
  Words words;
  for (std::uint64_t i = 0; i < *count; ++i) {
    split_words_into(without_comment(reader.require(atoms_wanted)), words);
    if (words.empty()) {
      reader.reject(fmt::format("the section ends after {} atoms; expected {} atoms", i, *count));
    }
    if (style == nullptr) style = &guessed_style(words, reader);
    add_data_atom(atoms, words, *style, reader);
  }
  // The next line must be blank, or the file must end. Otherwise the stated number of atoms was too
  // small.
  const auto after = reader.next();
  if (after && !trimmed(*after).empty()) {
    reader.reject(fmt::format("expected the section to end after {} atoms", *count));
  }
  return to_particles(std::move(atoms), colour, reader, first_line);
}

}  // namespace triptych::scene
