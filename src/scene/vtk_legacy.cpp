#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "scene/compression.hpp"
#include "scene/raw_voxels.hpp"
#include "scene/text_lines.hpp"
#include "scene/vtk_image.hpp"

namespace triptych::scene {
namespace {

constexpr std::size_t longest_vtk_header = std::size_t{1} << 20U;

// Reads the lines of a header, and keeps track of the position at which each line ends.
class VtkLines {
 public:
  explicit VtkLines(const std::filesystem::path& file)
      : file_(file.string()), text_(content_start(file, longest_vtk_header)), rest_(text_) {}

  // Returns the next line that is not blank. If there is none, throws an InputError whose message
  // contains `expected`.
  std::string_view next(std::string_view expected) {
    for (;;) {
      if (rest_.empty()) {
        reject(fmt::format("unexpected end of file; expected {}", expected));
      }
      const std::string_view line = any();
      if (!trimmed(line).empty()) return trimmed(line);
    }
  }
  // Returns the next line, which may be blank.
  std::string_view any() {
    const std::size_t length = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, length);
    rest_.remove_prefix(std::min(length + 1, rest_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++line_;
    return line;
  }
  // Returns whether the next line that is not blank begins with this word. Upper and lower case do
  // not matter.
  [[nodiscard]] bool follows(std::string_view word) const {
    std::string_view ahead = rest_;
    ahead.remove_prefix(std::min(ahead.find_first_not_of(" \t\r\n"), ahead.size()));
    return lower_case(ahead.substr(0, word.size())) == lower_case(word);
  }
  [[nodiscard]] std::uint64_t at() const { return text_.size() - rest_.size(); }
  [[nodiscard]] core::FilePlace place() const { return {.file = file_, .line = line_}; }
  [[noreturn]] void reject(const std::string& message) const {
    throw core::InputError(place(), message);
  }

 private:
  std::string file_;
  std::string text_;
  std::string_view rest_;
  int line_ = 0;
};

StoredType vtk_type(const VtkLines& lines, std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, StoredType>, 13> types{
      {{"unsigned_char", StoredType::u8},
       {"char", StoredType::i8},
       {"signed_char", StoredType::i8},
       {"unsigned_short", StoredType::u16},
       {"short", StoredType::i16},
       {"unsigned_int", StoredType::u32},
       {"int", StoredType::i32},
       {"unsigned_long", StoredType::u64},
       {"long", StoredType::i64},
       {"vtktypeuint64", StoredType::u64},
       {"vtktypeint64", StoredType::i64},
       {"float", StoredType::f32},
       {"double", StoredType::f64}}};
  const std::string lower = lower_case(name);
  for (const auto& [spelling, type] : types) {
    if (lower == spelling) return type;
  }
  lines.reject(
      fmt::format("type '{}' is not supported; expected unsigned_char, char, "
                  "unsigned_short, short, unsigned_int, int, unsigned_long, long, float or "
                  "double",
                  quotable(name)));
}

std::uint64_t count_of(const VtkLines& lines, std::string_view word) {
  const auto count = parse_number<std::uint32_t>(word);
  if (!count || *count == 0) {
    lines.reject(fmt::format("expected a whole number, 1 or more; found '{}'", quotable(word)));
  }
  return *count;
}

// The properties of the image, which the file states before the array.
struct VtkHeader {
  bool binary = false;
  std::string sizes;
  std::string spacing = "1 1 1";
  bool is_cell_data = false;
};

// Reads the lines up to POINT_DATA or CELL_DATA, and returns the number of values stated there.
std::uint64_t read_geometry(VtkLines& lines, VtkHeader& header) {
  for (;;) {
    const std::string_view line = lines.next("POINT_DATA");
    const auto words = split_words(line);
    const std::string key = lower_case(words.front());
    const std::string_view value = trimmed(line.substr(key.size()));
    if (key == "dimensions") {
      header.sizes = value;
    } else if (key == "spacing" || key == "aspect_ratio") {
      header.spacing = value;
    } else if (key == "point_data" || key == "cell_data") {
      header.is_cell_data = key == "cell_data";
      return count_of(lines, value);
    } else if (key == "field") {
      lines.reject(
          "a FIELD before POINT_DATA is not supported; remove it, or save the image as .vti");
    } else if (key != "origin" && key != "metadata" && key != "information" && key != "name" &&
               key != "data") {
      lines.reject(fmt::format("expected DIMENSIONS, SPACING, ORIGIN or POINT_DATA, found '{}'",
                               quotable(words.front())));
    }
  }
}

// Reads the lines that declare an array. The array's values follow these lines.
ValueLayout read_array(VtkLines& lines, const VtkHeader& header) {
  ValueLayout layout;
  layout.big_endian = true;
  std::string_view line = lines.next("SCALARS");
  auto words = split_words(line);
  const std::string key = lower_case(words.front());
  const auto need = [&](std::size_t count, std::string_view form) {
    if (words.size() < count) lines.reject(fmt::format("expected '{}'", form));
  };
  if (key == "scalars") {
    need(3, "SCALARS name type [components]");
    layout.type = vtk_type(lines, words[2]);
    if (words.size() > 3) layout.components = count_of(lines, words[3]);
    if (lines.follows("LOOKUP_TABLE")) static_cast<void>(lines.next("LOOKUP_TABLE"));
  } else if (key == "vectors" || key == "normals") {
    need(3, "VECTORS name type");
    layout.type = vtk_type(lines, words[2]);
    layout.components = 3;
  } else if (key == "color_scalars") {
    need(3, "COLOR_SCALARS name components");
    layout.type = header.binary ? StoredType::u8 : StoredType::f32;
    // A binary file contains bytes. An ASCII file contains numbers from 0 to 1. They are multiplied
    // by 255, so that both kinds of file result in the same values.
    if (!header.binary) layout.slope = 255;
    layout.components = count_of(lines, words[2]);
  } else if (key == "field") {
    line = lines.next("an array in the FIELD");
    words = split_words(line);
    need(4, "name components values type");
    layout.components = count_of(lines, words[1]);
    layout.type = vtk_type(lines, words[3]);
  } else {
    lines.reject(
        fmt::format("expected an array (SCALARS, COLOR_SCALARS, VECTORS, NORMALS or FIELD), "
                    "found '{}'",
                    quotable(words.front())));
  }
  return layout;
}

// Reads the lines before the geometry of the image.
VtkHeader read_header(VtkLines& lines) {
  if (!lines.any().starts_with("# vtk DataFile Version")) {
    lines.reject("this is not a VTK file; expected '# vtk DataFile Version'");
  }
  static_cast<void>(lines.any());  // a title
  VtkHeader header;
  const std::string kind = lower_case(lines.next("ASCII or BINARY"));
  if (kind != "ascii" && kind != "binary") {
    lines.reject(fmt::format("expected ASCII or BINARY, found '{}'", quotable(kind)));
  }
  header.binary = kind == "binary";
  const std::string dataset = lower_case(lines.next("DATASET"));
  const auto words = split_words(dataset);
  if (words.size() != 2 || words[0] != "dataset" || words[1] != "structured_points") {
    lines.reject(
        fmt::format("expected DATASET STRUCTURED_POINTS, found '{}'; to convert other "
                    "datasets, use the ParaView filter Resample To Image",
                    quotable(dataset)));
  }
  return header;
}

}  // namespace

Volume read_vtk(const std::filesystem::path& file, const Component& component) {
  VtkLines lines(file);
  VtkHeader header = read_header(lines);
  const std::uint64_t count = read_geometry(lines, header);
  if (header.sizes.empty()) lines.reject("expected DIMENSIONS before the data");
  Volume volume;
  volume.size = parse_sizes(header.sizes, lines.place());
  for (int& size : volume.size) size -= header.is_cell_data && size > 1 ? 1 : 0;
  volume.spacing = parse_spacings(header.spacing, volume.size, lines.place());
  if (static_cast<std::uint64_t>(volume.size[0]) * static_cast<std::uint64_t>(volume.size[1]) >
          count ||
      volume.voxel_count() != count) {
    lines.reject(fmt::format(
        "the file declares {} values for {} x {} x {} voxels; expected one value per voxel", count,
        volume.size[0], volume.size[1], volume.size[2]));
  }
  RawVoxels source;
  source.layout = read_array(lines, header);
  source.file = file;
  source.packing = packing_of_file(file);
  source.start = lines.at();
  source.encoding = header.binary ? RawEncoding::plain : RawEncoding::text;
  source.component = component;
  source.more_may_follow = true;
  source.sizes_place = lines.place();
  read_voxels(volume, source);
  return volume;
}

}  // namespace triptych::scene
