#include "scene/metaimage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "scene/compression.hpp"
#include "scene/header_fields.hpp"
#include "scene/raw_voxels.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

constexpr std::size_t longest_meta_header = std::size_t{1} << 20U;

struct MetaField {
  std::string value;
  core::FilePlace place;
};

class MetaHeader {
 public:
  explicit MetaHeader(const std::filesystem::path& file) : file_(file.string()) {
    const std::string text = content_start(file, longest_meta_header);
    std::string_view rest = without_mark(text);
    int line_number = 0;
    while (!rest.empty()) {
      const std::size_t length = std::min(rest.find('\n'), rest.size());
      const std::string_view line = trimmed(rest.substr(0, length));
      rest.remove_prefix(std::min(length + 1, rest.size()));
      const core::FilePlace place{.file = file_, .line = ++line_number};
      if (lists_files_) {
        if (!line.empty()) files_.push_back({std::string(line), place});
      } else if (!line.empty()) {
        add(line, place);
      }
      if (!lists_files_ && find("elementdatafile") != nullptr) {
        data_start_ = text.size() - rest.size();
        return;
      }
    }
    static_cast<void>(require("ElementDataFile"));
  }

  [[nodiscard]] const MetaField* find(const std::string& key) const {
    const auto found = fields_.find(key);
    return found == fields_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] const MetaField& require(const std::string& key) const {
    const MetaField* field = find(lower_case(key));
    if (field == nullptr) {
      throw core::InputError({.file = file_},
                             fmt::format("the header contains no line '{} = …'", key));
    }
    return *field;
  }
  // Returns whether the value of a key is True, or `default_value` if the key is missing.
  [[nodiscard]] bool flag(const std::string& key, bool default_value) const {
    const MetaField* field = find(key);
    if (field == nullptr) return default_value;
    const std::string value = lower_case(field->value);
    if (value == "true" || value == "1") return true;
    if (value == "false" || value == "0") return false;
    throw core::InputError(
        field->place, fmt::format("found '{}'; expected True or False", quotable(field->value)));
  }
  [[nodiscard]] std::uint64_t data_start() const { return data_start_; }
  [[nodiscard]] const std::vector<MetaField>& listed_files() const { return files_; }

 private:
  void add(std::string_view line, const core::FilePlace& place) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      throw core::InputError(place,
                             fmt::format("expected 'Key = value', found '{}'", quotable(line)));
    }
    const std::string key = lower_case(trimmed(line.substr(0, equals)));
    const std::string value(trimmed(line.substr(equals + 1)));
    if (!fields_.emplace(key, MetaField{value, place}).second) {
      throw core::InputError(place, fmt::format("key '{}' is given twice", quotable(key)));
    }
    lists_files_ = key == "elementdatafile" && (value == "LIST" || value.starts_with("LIST "));
  }

  std::string file_;
  std::map<std::string, MetaField> fields_;
  std::vector<MetaField> files_;
  bool lists_files_ = false;
  std::uint64_t data_start_ = 0;
};

StoredType meta_type(const MetaField& field) {
  static constexpr std::array<std::pair<std::string_view, StoredType>, 12> types{
      {{"met_uchar", StoredType::u8},
       {"met_char", StoredType::i8},
       {"met_ushort", StoredType::u16},
       {"met_short", StoredType::i16},
       {"met_uint", StoredType::u32},
       {"met_int", StoredType::i32},
       {"met_ulong_long", StoredType::u64},
       {"met_long_long", StoredType::i64},
       {"met_float", StoredType::f32},
       {"met_double", StoredType::f64},
       // ITK writes these two types with four bytes.
       {"met_ulong", StoredType::u32},
       {"met_long", StoredType::i32}}};
  const std::string name = lower_case(field.value);
  for (const auto& [spelling, type] : types) {
    if (name == spelling) return type;
  }
  throw core::InputError(field.place,
                         fmt::format("type '{}' is not supported; expected MET_UCHAR, MET_CHAR, "
                                     "MET_USHORT, MET_SHORT, MET_UINT, MET_INT, MET_ULONG_LONG, "
                                     "MET_LONG_LONG, MET_FLOAT or MET_DOUBLE",
                                     quotable(field.value)));
}

std::uint64_t whole_number(const MetaField& field) {
  const auto number = parse_number<std::uint32_t>(field.value);
  if (!number || *number == 0) {
    throw core::InputError(
        field.place,
        fmt::format("found '{}'; expected a whole number, 1 or more", quotable(field.value)));
  }
  return *number;
}

// Returns the first three words of a field that has one word per dimension. They belong to the
// spatial axes.
std::string first_three(const MetaField& field, std::uint64_t dimensions) {
  auto words = split_words(field.value);
  if (words.size() != dimensions) {
    throw core::InputError(field.place,
                           fmt::format("expected {} values, got {}", dimensions, words.size()));
  }
  words.resize(3);
  return fmt::format("{}", fmt::join(words, " "));
}

void set_meta_sizes(const MetaHeader& header, Volume& volume, ValueLayout& layout) {
  const MetaField& dims = header.require("NDims");
  const std::uint64_t dimensions = whole_number(dims);
  if (dimensions != 3 && dimensions != 4) {
    throw core::InputError(
        dims.place, fmt::format("the volume has {} dimensions; expected 3 or 4", dimensions));
  }
  const MetaField& sizes = header.require("DimSize");
  volume.size = parse_sizes(first_three(sizes, dimensions), sizes.place);
  const MetaField* channels = header.find("elementnumberofchannels");
  if (channels != nullptr) layout.components = whole_number(*channels);
  if (dimensions == 4) {
    const std::uint64_t further =
        whole_number({std::string(split_words(sizes.value)[3]), sizes.place});
    if (further > 1 && layout.components > 1) {
      throw core::InputError(sizes.place,
                             "the volume has both multiple channels and a fourth dimension; only "
                             "one of them is supported");
    }
    if (further > 1) layout.block = volume.voxel_count();
    layout.components *= further;
  }
  const MetaField* spacing = header.find("elementspacing");
  if (spacing == nullptr) spacing = header.find("elementsize");
  if (spacing == nullptr) return;
  volume.spacing = parse_spacings(first_three(*spacing, dimensions), volume.size, spacing->place);
}

// Records the directions of the axes, which are the rows of TransformMatrix, in LPS space.
void note_directions(const MetaHeader& header, Volume& volume) {
  for (const char* key : {"transformmatrix", "orientation", "rotation"}) {
    const MetaField* field = header.find(key);
    if (field == nullptr) continue;
    const auto words = split_words(field->value);
    if (words.size() != 9) return;  // a volume with four dimensions has a larger matrix
    std::array<Vector3, 3> axes{};
    for (std::size_t i = 0; i < 9; ++i) {
      const auto number = parse_number<double>(words[i]);
      if (!number) {
        throw core::InputError(field->place,
                               fmt::format("found '{}'; expected a number", quotable(words[i])));
      }
      axes.at(i / 3).at(i % 3) = *number;
    }
    if (const std::string sheared = sheared_axes(axes); !sheared.empty()) {
      throw core::InputError(
          field->place,
          fmt::format("{} are not perpendicular; sheared grids are not supported", sheared));
    }
    volume.facts.orientation = anatomical_letters(axes, "LPS");
    return;
  }
}

bool is_big_endian(const MetaHeader& header) {
  for (const char* key : {"elementbyteordermsb", "binarydatabyteordermsb"}) {
    if (header.find(key) != nullptr) return header.flag(key, false);
  }
  return false;
}

RawVoxels locate_voxels(const MetaHeader& header, const std::filesystem::path& file) {
  RawVoxels source;
  const MetaField& data = header.require("ElementDataFile");
  const std::string name = lower_case(data.value);
  if (!header.listed_files().empty()) {
    for (const MetaField& each : header.listed_files()) {
      const auto found = find_data_file(file, each.value, each.place);
      if (source.file.empty()) {
        source.file = found;
      } else {
        source.more_files.push_back(found);
      }
    }
  } else if (name == "local") {
    source.file = file;
    source.packing = packing_of_file(file);
    source.start = header.data_start();
  } else if (name.find('%') != std::string::npos && split_words(data.value).size() > 1) {
    throw core::InputError(data.place,
                           "file name patterns are not supported; expected the file names after "
                           "LIST, one per line");
  } else {
    source.file = find_data_file(file, data.value, data.place);
  }
  if (const MetaField* skip = header.find("headersize")) {
    const auto bytes = parse_number<std::int64_t>(skip->value);
    if (!bytes || *bytes < -1) {
      throw core::InputError(skip->place,
                             fmt::format("found '{}'; expected a whole number, 0 or more, or -1",
                                         quotable(skip->value)));
    }
    source.skip = *bytes;
  }
  const bool binary = header.flag("binarydata", true);
  const bool compressed = header.flag("compresseddata", false);
  if (!binary && compressed) {
    throw core::InputError(header.require("CompressedData").place,
                           "ASCII voxels cannot be compressed; expected BinaryData = True");
  }
  source.encoding = compressed ? RawEncoding::zlib
                    : binary   ? RawEncoding::plain
                               : RawEncoding::text;
  return source;
}

}  // namespace

Volume read_metaimage(const std::filesystem::path& file, const Component& component) {
  const MetaHeader header(file);
  if (const MetaField* object = header.find("objecttype");
      object != nullptr && lower_case(object->value) != "image") {
    throw core::InputError(object->place,
                           fmt::format("the object type '{}' is not a volume; expected Image",
                                       quotable(object->value)));
  }
  Volume volume;
  RawVoxels source = locate_voxels(header, file);
  set_meta_sizes(header, volume, source.layout);
  note_directions(header, volume);
  const MetaField& type = header.require("ElementType");
  // A type such as "MET_UCHAR_ARRAY" is one of several ways to declare that a voxel has several
  // channels.
  MetaField element = type;
  constexpr std::string_view array = "_array";
  if (lower_case(element.value).ends_with(array)) {
    element.value.resize(element.value.size() - array.size());
  }
  source.layout.type = meta_type(element);
  source.layout.big_endian = is_big_endian(header);
  source.component = component;
  source.sizes_place = header.require("DimSize").place;
  if (const MetaField* unit = header.find("distanceunits")) {
    volume.facts.unit = quotable(unit->value);
  }
  read_voxels(volume, source);
  return volume;
}

}  // namespace triptych::scene
