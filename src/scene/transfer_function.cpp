#include "scene/transfer_function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "core/error.hpp"
#include "core/file.hpp"
#include "scene/find_file.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

using Entry = std::array<float, 4>;
using Entries = std::array<Entry, 256>;

// A preset is linear in the normalised value x between these points.
struct ControlPoint {
  double x = 0;
  std::array<double, 4> rgba{};
};

// The opacities are a few per cent per voxel length, so that the background is visible even through
// a hundred voxels. The lowest eighth, which usually represents air in scans, is fully transparent.
constexpr std::array<ControlPoint, 7> haze{{
    {0.00, {0.05, 0.10, 0.30, 0}},
    {0.125, {0.08, 0.20, 0.55, 0}},
    {0.25, {0.15, 0.45, 0.80, 0.003}},
    {0.45, {0.35, 0.80, 0.75, 0.010}},
    {0.65, {0.95, 0.80, 0.40, 0.022}},
    {0.85, {0.98, 0.45, 0.20, 0.040}},
    {1.00, {1.00, 0.90, 0.80, 0.060}},
}};

// The opacity per voxel length has peaks at 0.40 and at 0.54, and is at least 0.80 from 0.68 on, so
// that a shell becomes opaque within a few voxels. The values between the shells are transparent.
// So are the values below them, because the lowest third is air and noise in most scans.
constexpr std::array<ControlPoint, 12> surfaces{{
    {0.00, {0.80, 0.45, 0.30, 0}},
    {0.35, {0.85, 0.52, 0.36, 0}},
    {0.40, {0.90, 0.60, 0.42, 0.25}},
    {0.45, {0.92, 0.66, 0.46, 0}},
    {0.49, {0.55, 0.70, 0.35, 0}},
    {0.54, {0.35, 0.70, 0.50, 0.50}},
    {0.59, {0.25, 0.65, 0.62, 0}},
    {0.62, {0.90, 0.85, 0.70, 0}},
    {0.68, {0.96, 0.91, 0.80, 0.80}},
    {0.75, {0.98, 0.94, 0.86, 0.98}},
    {0.90, {1.00, 0.97, 0.92, 0.98}},
    {1.00, {0.70, 0.85, 1.00, 0.98}},
}};

Entry interpolate(std::span<const ControlPoint> points, double x) {
  const auto after = std::find_if(points.begin() + 1, points.end() - 1,
                                  [x](const ControlPoint& p) { return x < p.x; });
  const ControlPoint& a = *(after - 1);
  const ControlPoint& b = *after;
  const double t = (x - a.x) / (b.x - a.x);
  Entry entry;
  for (std::size_t c = 0; c < 4; ++c) {
    entry.at(c) = static_cast<float>(a.rgba.at(c) * (1 - t) + b.rgba.at(c) * t);
  }
  return entry;
}

Entries tabulate(std::span<const ControlPoint> points) {
  Entries entries;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    entries.at(k) = interpolate(points, (static_cast<double>(k) + 0.5) / 256);
  }
  return entries;
}

struct Preset {
  std::string_view name;
  std::span<const ControlPoint> points;
};

constexpr std::array<Preset, 2> presets{{{"haze", haze}, {"surfaces", surfaces}}};

Entries from_bytes(std::span<const std::byte> bytes) {
  Entries entries;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    entries.at(i / 4).at(i % 4) = static_cast<float>(std::to_integer<int>(bytes[i]) / 255.0);
  }
  return entries;
}

std::array<double, 4> parse_entry(std::string_view text, const core::FilePlace& place) {
  const auto words = split_words(text);
  if (text.find_first_of(",;") != std::string_view::npos) {
    throw core::InputError(
        place,
        "expected four values (R G B A) separated by blanks, found a comma or semicolon; to "
        "convert: tr ',;' '  ' < IN > OUT");
  }
  if (words.size() != 4) {
    throw core::InputError(place,
                           fmt::format("expected four values (R G B A), got {}", words.size()));
  }
  std::array<double, 4> entry{};
  for (std::size_t c = 0; c < 4; ++c) {
    const auto number = parse_number<double>(words[c]);
    if (!number || !(*number >= 0 && *number <= 255)) {
      throw core::InputError(
          place,
          fmt::format("'{}' is not a channel value; expected a number from 0 to 255", words[c]));
    }
    entry.at(c) = *number;
  }
  return entry;
}

Entries from_text(std::string_view text, const std::string& file) {
  std::vector<std::array<double, 4>> values;
  double largest = 0;
  core::FilePlace place{.file = file};
  for (const std::string_view line : split_lines(text)) {
    ++place.line;
    if (split_words(line).empty() || line.starts_with('#')) continue;
    if (values.size() == 256) throw core::InputError(place, "the file has more than 256 entries");
    values.push_back(parse_entry(line, place));
    largest = std::max(largest, *std::max_element(values.back().begin(), values.back().end()));
  }
  if (values.size() != 256) {
    throw core::InputError(
        place, fmt::format("the file ends after {} entries; expected 256", values.size()));
  }
  Entries entries;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    for (std::size_t c = 0; c < 4; ++c) {
      entries.at(k).at(c) = static_cast<float>(values[k].at(c) / (largest > 1 ? 255 : 1));
    }
  }
  return entries;
}

// Returns whether the bytes look like the beginning of a text file. This is the case if there are
// several lines, and each of them is a comment or consists of characters that occur in numbers.
bool looks_like_text(std::string_view bytes) {
  const auto lines = split_lines(bytes);
  return lines.size() > 1 && std::ranges::all_of(lines, [](std::string_view line) {
           if (line.find_first_not_of("0123456789+-.eE \t") == std::string_view::npos) return true;
           const auto is_control = [](unsigned char c) { return c < ' ' && c != '\t'; };
           return line.starts_with('#') && std::ranges::none_of(line, is_control);
         });
}

Entries from_file(const std::filesystem::path& file) {
  const std::string text = core::read_text(file);
  const auto bytes = std::as_bytes(std::span(text));
  // A complete text file with 256 entries is longer than 1024 bytes, because the shortest entry
  // (four digits, three blanks and a line end) has 8 bytes. But a truncated text file can have any
  // length.
  const bool is_table = bytes.size() == 4 * std::tuple_size_v<Entries> && !looks_like_text(text);
  return is_table ? from_bytes(bytes) : from_text(text, file.string());
}

}  // namespace

TransferFunction load_transfer_function(std::string_view name,
                                        const std::vector<std::filesystem::path>& folders) {
  TransferFunction result;
  result.name = name;
  for (const Preset& preset : presets) {
    if (preset.name == name) {
      result.entries = tabulate(preset.points);
      return result;
    }
  }
  const auto file = find_file(name, folders);
  if (!file) {
    throw core::InputError(fmt::format(
        "transfer function '{}' is neither a preset (haze, surfaces) nor an existing file", name));
  }
  result.entries = from_file(*file);
  return result;
}

bool is_transparent(const TransferFunction& function, double lo, double hi) {
  // Between the centres of two entries, the opacity is interpolated. So the value x depends on the
  // entries at both sides of 256·x − ½.
  const auto entry = [](double place) {
    return static_cast<std::size_t>(std::clamp(place, 0.0, 255.0));
  };
  const std::size_t first = entry(std::floor(lo * 256 - 0.5));
  const std::size_t last = entry(std::ceil(hi * 256 - 0.5));
  return std::all_of(function.entries.begin() + static_cast<std::ptrdiff_t>(first),
                     function.entries.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                     [](const auto& rgba) { return rgba[3] <= 0; });
}

std::vector<std::string_view> transfer_function_presets() {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets) names.push_back(preset.name);
  return names;
}

}  // namespace triptych::scene
