#include "scene/nrrd.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "scene/header_fields.hpp"
#include "scene/nrrd_header.hpp"
#include "scene/raw_voxels.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

using nrrd::Field;
using nrrd::Header;

StoredType parse_type(const Field& field) {
  struct Spelling {
    StoredType type;
    std::array<std::string_view, 7> names;
  };
  static constexpr std::array<Spelling, 10> spellings{{
      {StoredType::i8, {"signed char", "int8", "int8_t"}},
      {StoredType::u8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
      {StoredType::i16,
       {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
      {StoredType::u16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
      {StoredType::i32, {"int", "signed int", "int32", "int32_t"}},
      {StoredType::u32, {"uint", "unsigned int", "uint32", "uint32_t"}},
      {StoredType::i64,
       {"longlong", "long long", "long long int", "signed long long", "signed long long int",
        "int64", "int64_t"}},
      {StoredType::u64,
       {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
      {StoredType::f32, {"float"}},
      {StoredType::f64, {"double"}},
  }};
  const std::string name = lower_case(field.value);
  for (const Spelling& spelling : spellings) {
    if (!name.empty() &&
        std::find(spelling.names.begin(), spelling.names.end(), name) != spelling.names.end()) {
      return spelling.type;
    }
  }
  throw core::InputError(
      field.place, fmt::format("type '{}' is not supported; expected int8, uint8, int16, uint16, "
                               "int32, uint32, int64, uint64, float or double",
                               quotable(field.value)));
}

RawEncoding parse_encoding(const Field& field) {
  static constexpr std::array<std::pair<std::string_view, RawEncoding>, 9> encodings{
      {{"raw", RawEncoding::plain},
       {"gzip", RawEncoding::gzip},
       {"gz", RawEncoding::gzip},
       {"bzip2", RawEncoding::bzip2},
       {"bz2", RawEncoding::bzip2},
       {"text", RawEncoding::text},
       {"txt", RawEncoding::text},
       {"ascii", RawEncoding::text},
       {"hex", RawEncoding::hex}}};
  const std::string name = lower_case(field.value);
  for (const auto& [spelling, encoding] : encodings) {
    if (name == spelling) return encoding;
  }
  throw core::InputError(field.place, fmt::format("encoding '{}' is not supported; expected raw, "
                                                  "gzip, bzip2, ascii or hex",
                                                  quotable(field.value)));
}

bool parse_big_endian(const Header& header, const RawVoxels& source) {
  const Field* field = header.find("endian");
  if (field == nullptr) {
    if (bytes_of(source.layout.type) == 1 || source.encoding == RawEncoding::text) return false;
    throw core::InputError(header.require("type").place,
                           "values of several bytes need a field 'endian'");
  }
  const std::string name = lower_case(field->value);
  if (name == "little") return false;
  if (name == "big") return true;
  throw core::InputError(
      field->place, fmt::format("endian '{}'; expected little or big", quotable(field->value)));
}

using Vector = Vector3;

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

// The axis of four whose place in the fields of axes is left out: that of components.
using LeftOut = std::optional<std::size_t>;

std::array<Vector, 3> parse_directions(const Field& field, const LeftOut& left_out) {
  std::string_view text = field.value;
  std::array<Vector, 3> axes{};
  const std::size_t count = left_out ? 4 : 3;
  for (std::size_t axis = 0, i = 0; axis < count; ++axis) {
    constexpr std::string_view none = "none";
    if (axis != left_out) {
      axes.at(i++) = take_vector(text, field.place);
    } else if (text = trimmed(text); lower_case(text.substr(0, none.size())) == none) {
      text.remove_prefix(none.size());
    } else {
      static_cast<void>(take_vector(text, field.place));
    }
  }
  if (!trimmed(text).empty()) {
    throw core::InputError(field.place,
                           fmt::format("unexpected '{}' after three vectors", quotable(text)));
  }
  return axes;
}

std::array<double, 3> lengths_of(const std::array<Vector, 3>& axes, const std::array<int, 3>& size,
                                 const core::FilePlace& place) {
  std::array<double, 3> spacing{};
  for (std::size_t i = 0; i < 3; ++i) {
    spacing.at(i) = usable_spacing(length_of(axes.at(i)), size.at(i), place);
  }
  if (const std::string sheared = sheared_axes(axes); !sheared.empty()) {
    throw core::InputError(
        place, fmt::format("{} are not perpendicular; sheared grids are not supported", sheared));
  }
  return spacing;
}

// The words of a field that has one for each axis, without that of the components.
std::vector<std::string_view> words_of_axes(std::string_view value, const LeftOut& left_out) {
  auto words = split_words(value);
  if (left_out && words.size() == 4) {
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(*left_out));
  }
  return words;
}

// Where the axes begin or end, NaN where that is not known.
Vector parse_ends(const Field& field, const LeftOut& left_out) {
  const auto words = words_of_axes(field.value, left_out);
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
std::array<bool, 3> parse_node_centred(const Field* field, const LeftOut& left_out) {
  std::array<bool, 3> node{};
  if (field == nullptr) return node;
  const auto words = words_of_axes(field->value, left_out);
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
std::optional<Vector> spacing_of_ends(const Header& header, const std::array<int, 3>& size,
                                      const LeftOut& left_out) {
  const Field* lowest = header.find("axis mins");
  const Field* highest = header.find("axis maxs");
  if (lowest == nullptr || highest == nullptr) return std::nullopt;
  const Vector begin = parse_ends(*lowest, left_out);
  const Vector end = parse_ends(*highest, left_out);
  const auto is_nan = [](double each) { return std::isnan(each); };
  if (std::ranges::all_of(begin, is_nan) && std::ranges::all_of(end, is_nan)) return std::nullopt;
  const std::array<bool, 3> node = parse_node_centred(header.find("centerings"), left_out);
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

// The letters of a space whose axes have anatomical names, such as left-posterior-superior.
std::string orientation_of(const std::array<Vector, 3>& axes, const Field* space) {
  if (space == nullptr) return {};
  const std::string name = lower_case(space->value);
  static constexpr std::array<std::array<std::string_view, 2>, 6> spaces{
      {{"right-anterior-superior", "RAS"},
       {"ras", "RAS"},
       {"left-anterior-superior", "LAS"},
       {"las", "LAS"},
       {"left-posterior-superior", "LPS"},
       {"lps", "LPS"}}};
  for (const auto& [spelling, letters] : spaces) {
    if (name == spelling) return anatomical_letters(axes, letters);
  }
  return {};
}

void parse_spacing(const Header& header, const LeftOut& left_out, Volume& volume) {
  const Field* spacings = header.find("spacings");
  const Field* directions = header.find("space directions");
  if (spacings != nullptr && directions != nullptr) {
    throw core::InputError(directions->place,
                           "'space directions' and 'spacings' exclude each other");
  }
  if (directions != nullptr) {
    const std::array<Vector, 3> axes = parse_directions(*directions, left_out);
    volume.spacing = lengths_of(axes, volume.size, directions->place);
    volume.facts.orientation = orientation_of(axes, header.find("space"));
  } else if (spacings != nullptr) {
    const auto words = words_of_axes(spacings->value, left_out);
    volume.spacing = parse_spacings(fmt::format("{}", fmt::join(words, " ")), volume.size,
                                    spacings->place);
  } else {
    volume.spacing = spacing_of_ends(header, volume.size, left_out).value_or(Vector{1, 1, 1});
  }
}

// The first unit of a list of units in quotes: '"mm" "mm" "mm"'.
std::string unit_of(const Header& header) {
  for (const char* name : {"space units", "units"}) {
    const Field* field = header.find(name);
    if (field == nullptr) continue;
    std::size_t at = 0;
    while ((at = field->value.find('"', at)) != std::string::npos) {
      const std::size_t end = field->value.find('"', at + 1);
      if (end == std::string::npos) break;
      if (end > at + 1) return quotable(field->value.substr(at + 1, end - at - 1));
      at = end + 1;
    }
  }
  return {};
}

bool is_space(std::string_view kind) {
  const std::string name = lower_case(kind);
  return name == "domain" || name == "space" || name == "none" || name == "???";
}

// Colours or vectors along one of three axes would be drawn as if they were places.
void require_places(const Field& kinds) {
  const auto words = split_words(kinds.value);
  if (words.size() != 3) {
    throw core::InputError(kinds.place, fmt::format("expected 3 kinds, got {}", words.size()));
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (is_space(words[i])) continue;
    throw core::InputError(
        kinds.place, fmt::format("kind '{}' of axis {}; expected domain or space, or a fourth axis: "
                                 "a volume has three axes in space",
                                 quotable(words[i]), i));
  }
}

// Finds the component axis among four: the one whose kind is not spatial, else the one without a
// direction, else the only one of size 1.
std::size_t component_axis(const Header& header, const std::vector<std::string_view>& sizes) {
  const core::FilePlace& place = header.require("dimension").place;
  std::vector<std::size_t> found;
  if (const Field* kinds = header.find("kinds")) {
    const auto words = split_words(kinds->value);
    if (words.size() != 4) {
      throw core::InputError(kinds->place, fmt::format("expected 4 kinds, got {}", words.size()));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if (!is_space(words[i])) found.push_back(i);
    }
  }
  if (const Field* directions = header.find("space directions"); found.empty() && directions) {
    // "none" stands where a vector would be.
    std::size_t axis = 0;
    bool inside = false;
    for (std::size_t i = 0; i < directions->value.size(); ++i) {
      const char c = directions->value[i];
      if (c == '(') inside = true;
      if (c == ')') inside = false;
      if (c == ')') ++axis;
      if (!inside && lower_case(directions->value.substr(i, 4)) == "none") found.push_back(axis++);
    }
  }
  if (found.empty()) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (sizes[i] == "1") found.push_back(i);
    }
  }
  if (found.size() == 1 && found.front() < 4) return found.front();
  throw core::InputError(place,
                         "expected 3 axes, or 4 of which 'kinds' or 'space directions' states the one "
                         "that is not spatial, as in 'kinds: vector domain domain domain'");
}

// Sizes, and for four axes the layout of the components.
LeftOut parse_axes(const Header& header, Volume& volume, ValueLayout& layout) {
  const Field& dimension = header.require("dimension");
  const Field& sizes = header.require("sizes");
  const auto axes = parse_number<int>(dimension.value);
  if (axes != 3 && axes != 4) {
    throw core::InputError(dimension.place,
                           fmt::format("dimension '{}'; expected 3 axes, or 4 of which one is not "
                                       "spatial",
                                       quotable(dimension.value)));
  }
  if (axes == 3) {
    if (const Field* kinds = header.find("kinds")) require_places(*kinds);
    volume.size = parse_sizes(sizes.value, sizes.place);
    return std::nullopt;
  }
  const auto words = split_words(sizes.value);
  if (words.size() != 4) {
    throw core::InputError(sizes.place, fmt::format("expected 4 sizes, got {}", words.size()));
  }
  const std::size_t axis = component_axis(header, words);
  volume.size = parse_sizes(fmt::format("{}", fmt::join(words_of_axes(sizes.value, axis), " ")),
                            sizes.place);
  const auto count = parse_number<std::uint32_t>(words[axis]);
  if (!count || *count == 0) {
    throw core::InputError(sizes.place, fmt::format("size '{}' along axis {}; expected a whole "
                                                    "number from 1 on",
                                                    quotable(words[axis]), axis));
  }
  layout.components = *count;
  for (std::size_t i = 0; i < axis; ++i) {
    layout.block *= static_cast<std::uint64_t>(volume.size.at(i));
  }
  return axis;
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

// A pattern, "FORMAT MIN MAX STEP" with perhaps a dimension behind; a name alone may have a '%' in
// it. Nothing where it is none.
std::optional<std::vector<std::string>> files_of_pattern(std::string_view value,
                                                         const core::FilePlace& place) {
  constexpr std::size_t most_files = 100'000;
  auto words = split_words(value);
  if (words.size() < 4) return std::nullopt;
  // A dimension may stand behind the three numbers.
  std::size_t first = words.size() - 3;
  const auto is_number = [](std::string_view word) { return parse_number<int>(word).has_value(); };
  if (first >= 2 && is_number(words[first - 1])) --first;
  const bool range = is_number(words[first]) && is_number(words[first + 1]) &&
                     is_number(words[first + 2]);
  const std::string_view name =
      trimmed(value.substr(0, static_cast<std::size_t>(words[first].data() - value.data())));
  const std::size_t percent = name.find('%');
  if (!range || percent == std::string_view::npos) return std::nullopt;
  const std::size_t end = name.find_first_not_of("0123456789", percent + 1);
  if (end == std::string_view::npos || (name[end] != 'd' && name[end] != 'u' && name[end] != 'i')) {
    throw core::InputError(place, "expected a pattern such as slice%03d.raw MIN MAX STEP");
  }
  const std::string_view width = name.substr(percent + 1, end - percent - 1);
  const auto digits = width.empty() ? std::optional<int>(0) : parse_number<int>(width);
  const int lo = *parse_number<int>(words[first]);
  const int hi = *parse_number<int>(words[first + 1]);
  const int step = *parse_number<int>(words[first + 2]);
  if (step == 0 || !digits || *digits > 20) {
    throw core::InputError(place, "expected a pattern with a STEP other than 0");
  }
  std::vector<std::string> names;
  for (std::int64_t i = lo; step > 0 ? i <= hi : i >= hi; i += step) {
    if (names.size() == most_files) throw core::InputError(place, "more than 100000 files");
    const std::string number = width.starts_with('0') ? fmt::format("{:0{}}", i, *digits)
                                                      : fmt::format("{:{}}", i, *digits);
    names.push_back(fmt::format("{}{}{}", name.substr(0, percent), number, name.substr(end + 1)));
  }
  return names;
}

// The files that the field names, in their order.
void locate_files(const Header& header, const Field& data, const std::filesystem::path& file,
                  RawVoxels& source) {
  std::vector<Field> named;
  if (!header.listed_files().empty()) {
    named = header.listed_files();
  } else if (auto names = files_of_pattern(data.value, data.place)) {
    for (std::string& name : *names) named.push_back({std::move(name), data.place});
  } else if (data.value == "LIST" || data.value.starts_with("LIST ")) {
    throw core::InputError(data.place, "expected the names of the data files after LIST, one a line");
  } else {
    named.push_back(data);
  }
  if (named.empty()) throw core::InputError(data.place, "the pattern names no file");
  for (const Field& each : named) {
    const auto found = data_file_beside(file, each.value, each.place);
    if (source.file.empty()) {
      source.file = found;
    } else {
      source.more_files.push_back(found);
    }
  }
}

RawVoxels locate(const Header& header, const std::filesystem::path& file) {
  RawVoxels source;
  source.encoding = parse_encoding(header.require("encoding"));
  source.sizes_place = header.require("sizes").place;
  if (const Field* data = header.find("data file")) {
    locate_files(header, *data, file, source);
  } else if (header.data_start()) {
    source.file = file;
    source.packing = packing_of_file(file);
    source.start = *header.data_start();
  } else {
    throw core::InputError(header.last_line(),
                           "the header ends without the blank line before the data");
  }
  const Field* lines = header.find("line skip");
  const std::int64_t line_count = parse_skip(lines, 0, "a whole number from 0 on");
  if (line_count > 0) {
    if (source.packing != Packing::none || !source.more_files.empty()) {
      throw core::InputError(lines->place,
                             "'line skip' is read only of a single file that is not compressed");
    }
    source.start = skip_lines(source.file, source.start, line_count, lines->place);
  }
  source.skip = parse_skip(header.find("byte skip"), RawVoxels::at_end,
                           "a whole number from 0 on, or -1");
  return source;
}

}  // namespace

Volume read_nrrd(const std::filesystem::path& file, const Component& component) {
  const Header header(file);
  Volume volume;
  ValueLayout layout;
  layout.type = parse_type(header.require("type"));
  const LeftOut left_out = parse_axes(header, volume, layout);
  parse_spacing(header, left_out, volume);
  volume.facts.unit = unit_of(header);
  RawVoxels source = locate(header, file);
  source.layout = layout;
  source.layout.big_endian = parse_big_endian(header, source);
  source.component = component;
  read_voxels(volume, source);
  return volume;
}

}  // namespace triptych::scene
