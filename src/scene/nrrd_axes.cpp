#include "scene/nrrd_axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "scene/header_fields.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene::nrrd {
namespace {

using Vector = Vector3;

// Removes a vector "(a,b,c)" from the beginning of `text`, and returns its numbers.
Vector parse_vector(std::string_view& text, const core::FilePlace& place) {
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
    throw core::InputError(place,
                           fmt::format("the vector has {} numbers; expected 3", words.size()));
  }
  for (std::size_t c = 0; c < vector.size(); ++c) {
    const auto number = parse_number<double>(words[c]);
    if (!number || !std::isfinite(*number)) {
      throw core::InputError(
          place, fmt::format("found '{}'; expected a finite number", quotable(words[c])));
    }
    vector.at(c) = *number;
  }
  return vector;
}

std::array<Vector, 3> parse_directions(const Field& field, const ComponentAxis& component_axis) {
  std::string_view text = field.value;
  std::array<Vector, 3> axes{};
  const std::size_t count = component_axis ? 4 : 3;
  for (std::size_t axis = 0, i = 0; axis < count; ++axis) {
    constexpr std::string_view none = "none";
    if (axis != component_axis) {
      axes.at(i++) = parse_vector(text, field.place);
    } else if (text = trimmed(text); lower_case(text.substr(0, none.size())) == none) {
      text.remove_prefix(none.size());
    } else {
      static_cast<void>(parse_vector(text, field.place));
    }
  }
  if (!trimmed(text).empty()) {
    throw core::InputError(field.place,
                           fmt::format("unexpected '{}' after the three vectors", quotable(text)));
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

// Returns the words of a field with one word per axis, without the word for the component axis.
std::vector<std::string_view> words_of_axes(std::string_view value,
                                            const ComponentAxis& component_axis) {
  auto words = split_words(value);
  if (component_axis && words.size() == 4) {
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(*component_axis));
  }
  return words;
}

// Returns the positions at which the axes begin or end. Unknown positions are NaN.
Vector parse_ends(const Field& field, const ComponentAxis& component_axis) {
  const auto words = words_of_axes(field.value, component_axis);
  Vector ends{};
  if (words.size() != ends.size()) {
    throw core::InputError(field.place,
                           fmt::format("expected 3 values, one per axis; got {}", words.size()));
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto number = parse_number<double>(words[i]);
    if (!number) {
      throw core::InputError(field.place,
                             fmt::format("found '{}'; expected a number", quotable(words[i])));
    }
    ends.at(i) = *number;
  }
  return ends;
}

// Returns, for each axis, whether the first and last samples are at the ends of the axis. Otherwise
// samples are in the middle of cells, which is also the default of the NRRD reference
// implementation.
std::array<bool, 3> parse_node_centred(const Field* field, const ComponentAxis& component_axis) {
  std::array<bool, 3> node{};
  if (field == nullptr) return node;
  const auto words = words_of_axes(field->value, component_axis);
  if (words.size() != node.size()) {
    throw core::InputError(field->place,
                           fmt::format("expected 3 centerings, got {}", words.size()));
  }
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string name = lower_case(words[i]);
    node.at(i) = name == "node";
    if (node.at(i) || name == "cell" || name == "none" || name == "???") continue;
    throw core::InputError(field->place,
                           fmt::format("unknown centering '{}' of axis {}; expected cell or node",
                                       quotable(words[i]), i));
  }
  return node;
}

// Computes the spacing from the ends of the axes. Returns nullopt if no axis has known ends.
std::optional<Vector> spacing_of_ends(const Header& header, const std::array<int, 3>& size,
                                      const ComponentAxis& component_axis) {
  const Field* lowest = header.find("axis mins");
  const Field* highest = header.find("axis maxs");
  if (lowest == nullptr || highest == nullptr) return std::nullopt;
  const Vector begin = parse_ends(*lowest, component_axis);
  const Vector end = parse_ends(*highest, component_axis);
  const auto is_nan = [](double each) { return std::isnan(each); };
  if (std::ranges::all_of(begin, is_nan) && std::ranges::all_of(end, is_nan)) return std::nullopt;
  const std::array<bool, 3> node = parse_node_centred(header.find("centerings"), component_axis);
  Vector spacing{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = std::abs(end.at(i) - begin.at(i));
    const int steps = node.at(i) ? size.at(i) - 1 : size.at(i);
    if (steps == 0) {
      throw core::InputError(
          highest->place,
          fmt::format("axis {} has only one node-centred sample, so its spacing cannot be "
                      "computed from 'axis mins' and 'axis maxs'; expected the field 'spacings'",
                      i));
    }
    spacing.at(i) = usable_spacing(length / steps, size.at(i), highest->place);
  }
  return spacing;
}

// Returns the orientation in letters if the space's axes have anatomical names, such as
// left-posterior-superior. Otherwise returns an empty string.
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

bool is_space(std::string_view kind) {
  const std::string name = lower_case(kind);
  return name == "domain" || name == "space" || name == "none" || name == "???";
}

// Rejects a file with three axes if one of them is not spatial, because its colours or vector
// components would be drawn as if they were positions in space.
void require_places(const Field& kinds) {
  const auto words = split_words(kinds.value);
  if (words.size() != 3) {
    throw core::InputError(kinds.place, fmt::format("expected 3 kinds, got {}", words.size()));
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (is_space(words[i])) continue;
    throw core::InputError(
        kinds.place,
        fmt::format(
            "the kind '{}' of axis {} is not spatial; expected domain or space, because three "
            "axes must be spatial and only a fourth axis may have another kind",
            quotable(words[i]), i));
  }
}

// Finds the component axis among four axes. This is the axis whose kind is not spatial, or else the
// axis without a direction, or else the only axis of size 1.
std::size_t find_component_axis(const Header& header, const std::vector<std::string_view>& sizes) {
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
    // The word "none" may replace a vector.
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
  throw core::InputError(
      place,
      "expected 3 axes, or 4 axes with the non-spatial axis identified by 'kinds' or 'space "
      "directions', for example 'kinds: vector domain domain domain'");
}

}  // namespace

ComponentAxis parse_axes(const Header& header, Volume& volume, ValueLayout& layout) {
  const Field& dimension = header.require("dimension");
  const Field& sizes = header.require("sizes");
  const auto axes = parse_number<int>(dimension.value);
  if (axes != 3 && axes != 4) {
    throw core::InputError(
        dimension.place,
        fmt::format("the dimension is '{}'; expected 3, or 4 if one axis is not spatial",
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
  const std::size_t axis = find_component_axis(header, words);
  volume.size =
      parse_sizes(fmt::format("{}", fmt::join(words_of_axes(sizes.value, axis), " ")), sizes.place);
  const auto count = parse_number<std::uint32_t>(words[axis]);
  if (!count || *count == 0) {
    throw core::InputError(
        sizes.place,
        fmt::format("the size is '{}' along axis {}; expected a whole number, 1 or more",
                    quotable(words[axis]), axis));
  }
  layout.components = *count;
  for (std::size_t i = 0; i < axis; ++i) {
    layout.block *= static_cast<std::uint64_t>(volume.size.at(i));
  }
  return axis;
}

void parse_spacing(const Header& header, const ComponentAxis& component_axis, Volume& volume) {
  const Field* spacings = header.find("spacings");
  const Field* directions = header.find("space directions");
  if (spacings != nullptr && directions != nullptr) {
    throw core::InputError(directions->place,
                           "'space directions' and 'spacings' are mutually exclusive");
  }
  if (directions != nullptr) {
    const std::array<Vector, 3> axes = parse_directions(*directions, component_axis);
    volume.spacing = lengths_of(axes, volume.size, directions->place);
    volume.facts.orientation = orientation_of(axes, header.find("space"));
  } else if (spacings != nullptr) {
    const auto words = words_of_axes(spacings->value, component_axis);
    volume.spacing =
        parse_spacings(fmt::format("{}", fmt::join(words, " ")), volume.size, spacings->place);
  } else {
    volume.spacing = spacing_of_ends(header, volume.size, component_axis).value_or(Vector{1, 1, 1});
  }
}

// Returns the first unit that is not empty. Units are a list of quoted strings, such as '"mm" "mm"
// "mm"'.
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

}  // namespace triptych::scene::nrrd
