#include "scene/nrrd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "scene/nrrd_header.hpp"
#include "scene/raw_voxels.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

using nrrd::Field;
using nrrd::Header;

ScalarType parse_type(const Field& field) {
  struct Spelling {
    ScalarType type;
    std::array<std::string_view, 6> names;
  };
  static constexpr std::array<Spelling, 6> spellings{{
      {ScalarType::i8, {"signed char", "int8", "int8_t"}},
      {ScalarType::u8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
      {ScalarType::i16,
       {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
      {ScalarType::u16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
      {ScalarType::f32, {"float"}},
      {ScalarType::f64, {"double"}},
  }};
  const std::string name = lower_case(field.value);
  for (const Spelling& spelling : spellings) {
    if (!name.empty() &&
        std::find(spelling.names.begin(), spelling.names.end(), name) != spelling.names.end()) {
      return spelling.type;
    }
  }
  throw core::InputError(
      field.place,
      fmt::format(
          "type '{}' is not supported; expected int8, uint8, int16, uint16, float or double",
          quotable(field.value)));
}

RawEncoding parse_encoding(const Field& field) {
  const std::string name = lower_case(field.value);
  if (name == "raw") return RawEncoding::plain;
  if (name == "gzip" || name == "gz") return RawEncoding::gzip;
  throw core::InputError(
      field.place,
      fmt::format("encoding '{}' is not supported; expected raw or gzip", quotable(field.value)));
}

bool parse_big_endian(const Header& header, ScalarType type) {
  const Field* field = header.find("endian");
  if (field == nullptr) {
    if (bytes_of(type) == 1) return false;
    throw core::InputError(header.require("type").place,
                           "values of several bytes need a field 'endian'");
  }
  const std::string name = lower_case(field->value);
  if (name == "little") return false;
  if (name == "big") return true;
  throw core::InputError(
      field->place, fmt::format("endian '{}'; expected little or big", quotable(field->value)));
}

using Vector = std::array<double, 3>;

// One "(a,b,c)", taken off the front of `text`.
Vector take_vector(std::string_view& text, const core::FilePlace& place) {
  const std::size_t open = text.find_first_not_of(" \t");
  const std::size_t close = text.find(')');
  if (open == std::string_view::npos || text[open] != '(' || close == std::string_view::npos) {
    throw core::InputError(place, "expected three vectors (a,b,c) (d,e,f) (g,h,i)");
  }
  std::string inside(text.substr(open + 1, close - open - 1));
  std::replace(inside.begin(), inside.end(), ',', ' ');
  text.remove_prefix(close + 1);
  const auto words = split_words(inside);
  Vector vector{};
  if (words.size() != vector.size()) {
    throw core::InputError(place, fmt::format("a vector of {} numbers; expected 3", words.size()));
  }
  for (std::size_t c = 0; c < vector.size(); ++c) {
    const auto number = parse_number<double>(words[c]);
    if (!number || !std::isfinite(*number)) {
      throw core::InputError(place,
                             fmt::format("'{}'; expected a finite number", quotable(words[c])));
    }
    vector.at(c) = *number;
  }
  return vector;
}

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::array<double, 3> parse_directions(const Field& field, const std::array<int, 3>& size) {
  constexpr double largest_cosine = 1e-3;
  std::string_view text = field.value;
  std::array<Vector, 3> axes{};
  std::array<double, 3> spacing{};
  for (std::size_t i = 0; i < 3; ++i) {
    axes.at(i) = take_vector(text, field.place);
    spacing.at(i) = usable_spacing(std::sqrt(dot(axes.at(i), axes.at(i))), size.at(i), field.place);
  }
  if (!trimmed(text).empty()) {
    throw core::InputError(field.place,
                           fmt::format("unexpected '{}' after three vectors", quotable(text)));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (std::abs(dot(axes.at(i), axes.at(j))) > largest_cosine * spacing.at(i) * spacing.at(j)) {
      throw core::InputError(field.place,
                             fmt::format("axes {} and {} are not perpendicular; sheared grids are "
                                         "not supported",
                                         i, j));
    }
  }
  return spacing;
}

// Where the axes begin or end, NaN where that is not known.
Vector parse_ends(const Field& field) {
  const auto words = split_words(field.value);
  Vector ends{};
  if (words.size() != ends.size()) {
    throw core::InputError(field.place,
                           fmt::format("expected 3 ends of axes, got {}", words.size()));
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto number = parse_number<double>(words[i]);
    if (!number) {
      throw core::InputError(field.place,
                             fmt::format("'{}'; expected a number", quotable(words[i])));
    }
    ends.at(i) = *number;
  }
  return ends;
}

// Whether samples stand at the ends of an axis; else they are the middles of cells, as the format's
// own library has it where nothing is said.
std::array<bool, 3> parse_node_centred(const Field* field) {
  std::array<bool, 3> node{};
  if (field == nullptr) return node;
  const auto words = split_words(field->value);
  if (words.size() != node.size()) {
    throw core::InputError(field->place,
                           fmt::format("expected 3 centerings, got {}", words.size()));
  }
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string name = lower_case(words[i]);
    node.at(i) = name == "node";
    if (node.at(i) || name == "cell" || name == "none" || name == "???") continue;
    throw core::InputError(
        field->place,
        fmt::format("centering '{}' of axis {}; expected cell or node", quotable(words[i]), i));
  }
  return node;
}

// From where the axes begin and end; nothing where that is not known of any.
std::optional<Vector> spacing_of_ends(const Header& header, const std::array<int, 3>& size) {
  const Field* lowest = header.find("axis mins");
  const Field* highest = header.find("axis maxs");
  if (lowest == nullptr || highest == nullptr) return std::nullopt;
  const Vector begin = parse_ends(*lowest);
  const Vector end = parse_ends(*highest);
  const auto is_nan = [](double each) { return std::isnan(each); };
  if (std::ranges::all_of(begin, is_nan) && std::ranges::all_of(end, is_nan)) return std::nullopt;
  const std::array<bool, 3> node = parse_node_centred(header.find("centerings"));
  Vector spacing{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = std::abs(end.at(i) - begin.at(i));
    const int steps = node.at(i) ? size.at(i) - 1 : size.at(i);
    if (steps == 0) {
      throw core::InputError(
          highest->place, fmt::format("axis {} has one sample, a node: its ends give no spacing; "
                                      "expected 'spacings'",
                                      i));
    }
    spacing.at(i) = usable_spacing(length / steps, size.at(i), highest->place);
  }
  return spacing;
}

std::array<double, 3> parse_spacing(const Header& header, const std::array<int, 3>& size) {
  const Field* spacings = header.find("spacings");
  const Field* directions = header.find("space directions");
  if (spacings != nullptr && directions != nullptr) {
    throw core::InputError(directions->place,
                           "'space directions' and 'spacings' exclude each other");
  }
  if (directions != nullptr) return parse_directions(*directions, size);
  if (spacings != nullptr) return parse_spacings(spacings->value, size, spacings->place);
  return spacing_of_ends(header, size).value_or(Vector{1, 1, 1});
}

// Colours or vectors along an axis would be drawn as if they were places.
void require_places(const Field& kinds) {
  const auto words = split_words(kinds.value);
  if (words.size() != 3) {
    throw core::InputError(kinds.place, fmt::format("expected 3 kinds, got {}", words.size()));
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string name = lower_case(words[i]);
    if (name == "domain" || name == "space" || name == "none" || name == "???") continue;
    throw core::InputError(
        kinds.place, fmt::format("kind '{}' of axis {}; expected domain or space: only volumes of "
                                 "one value a voxel are supported",
                                 quotable(words[i]), i));
  }
}

void require_three_axes(const Field& dimension) {
  if (parse_number<int>(dimension.value) != 3) {
    throw core::InputError(
        dimension.place, fmt::format("dimension '{}'; expected 3 axes", quotable(dimension.value)));
  }
}

std::int64_t parse_skip(const Field* field, std::int64_t lowest, std::string_view expected) {
  if (field == nullptr) return 0;
  const auto count = parse_number<std::int64_t>(field->value);
  if (!count || *count < lowest) {
    throw core::InputError(field->place,
                           fmt::format("'{}'; expected {}", quotable(field->value), expected));
  }
  return *count;
}

// Where `count` lines from `start` on end.
std::uint64_t skip_lines(const std::filesystem::path& file, std::uint64_t start, std::int64_t count,
                         const core::FilePlace& place) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(start));
  for (std::int64_t i = 0; i < count; ++i) {
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (!in || in.eof()) {
      throw core::InputError(
          place, fmt::format("{} has only {} lines to skip", file.filename().string(), i));
    }
  }
  return static_cast<std::uint64_t>(in.tellg());
}

// "LIST …" or a pattern, "FORMAT MIN MAX STEP" with perhaps a dimension behind. A name alone may
// have a '%' in it.
bool is_several_files(std::string_view name) {
  const auto words = split_words(name);
  if (!words.empty() && words[0] == "LIST") return true;
  if (words.size() < 4) return false;
  const auto range = words.end() - 3;
  return std::all_of(range, words.end(),
                     [](auto word) { return parse_number<int>(word).has_value(); }) &&
         std::any_of(words.begin(), range,
                     [](auto word) { return word.find('%') != std::string_view::npos; });
}

RawVoxels locate(const Header& header, const std::filesystem::path& file) {
  RawVoxels source;
  source.encoding = parse_encoding(header.require("encoding"));
  source.sizes_place = header.require("sizes").place;
  if (const Field* data = header.find("data file")) {
    if (is_several_files(data->value)) {
      throw core::InputError(data->place, "data spread over several files are not supported");
    }
    source.file = data_file_beside(file, data->value, data->place);
  } else if (header.data_start()) {
    source.file = file;
    source.start = *header.data_start();
  } else {
    throw core::InputError(header.last_line(),
                           "the header ends without the blank line before the data");
  }
  const Field* lines = header.find("line skip");
  const std::int64_t line_count = parse_skip(lines, 0, "a whole number from 0 on");
  if (line_count > 0) {
    source.start = skip_lines(source.file, source.start, line_count, lines->place);
  }
  const bool plain = source.encoding == RawEncoding::plain;
  source.skip = parse_skip(header.find("byte skip"), plain ? RawVoxels::at_end : 0,
                           plain ? "a whole number from 0 on, or -1" : "a whole number from 0 on");
  return source;
}

}  // namespace

Volume read_nrrd(const std::filesystem::path& file) {
  const Header header(file);
  require_three_axes(header.require("dimension"));
  if (const Field* kinds = header.find("kinds")) require_places(*kinds);
  Volume volume;
  volume.type = parse_type(header.require("type"));
  const Field& sizes = header.require("sizes");
  volume.size = parse_sizes(sizes.value, sizes.place);
  volume.spacing = parse_spacing(header, volume.size);
  RawVoxels source = locate(header, file);
  source.big_endian = parse_big_endian(header, volume.type);
  read_voxels(volume, source);
  return volume;
}

}  // namespace triptych::scene
