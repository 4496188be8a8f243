#include "scene/dat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "scene/raw_voxels.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

struct Entry {
  std::string value;
  core::FilePlace place;
};

class Description {
 public:
  explicit Description(const std::filesystem::path& file) : file_(file.string()) {
    const std::string text = core::read_text(file);
    core::FilePlace place{.file = file_};
    for (const std::string_view line : split_lines(without_mark(text))) {
      ++place.line;
      if (!trimmed(line).empty()) add(line, place);
    }
  }

  [[nodiscard]] const Entry* find(const std::string& key) const {
    const auto found = entries_.find(key);
    return found == entries_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] const Entry& require(const std::string& key, std::string_view spelling) const {
    const Entry* entry = find(key);
    if (entry == nullptr) {
      throw core::InputError({.file = file_}, fmt::format("the line '{}: …' is missing", spelling));
    }
    return *entry;
  }

 private:
  static constexpr std::array<std::string_view, 13> known{
      "objectfilename", "resolution", "format", "slicethickness", "endianness",
      // Some programs write `endianess`.
      "taggedfilename", "nbrtags", "objecttype", "objectmodel", "gridtype", "modality", "timestep",
      "endianess"};

  void add(std::string_view line, const core::FilePlace& place) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) throw core::InputError(place, "expected 'Key: value'");
    const std::string key = lower_case(trimmed(line.substr(0, colon)));
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw core::InputError(
          place, fmt::format("unknown key '{}'; expected ObjectFileName, Resolution, Format, "
                             "SliceThickness or Endianness",
                             quotable(trimmed(line.substr(0, colon)))));
    }
    const Entry entry{std::string(trimmed(line.substr(colon + 1))), place};
    if (!entries_.emplace(key, entry).second) {
      throw core::InputError(place, fmt::format("key '{}' is given twice", key));
    }
  }

  std::string file_;
  std::map<std::string, Entry> entries_;
};

StoredType parse_format(const Entry& entry) {
  static constexpr std::array<std::pair<std::string_view, StoredType>, 8> formats{
      {{"uchar", StoredType::u8},
       {"char", StoredType::i8},
       {"ushort", StoredType::u16},
       {"short", StoredType::i16},
       {"uint", StoredType::u32},
       {"int", StoredType::i32},
       {"float", StoredType::f32},
       {"double", StoredType::f64}}};
  for (const auto& [name, type] : formats) {
    if (name == lower_case(entry.value)) return type;
  }
  throw core::InputError(
      entry.place, fmt::format("unknown format '{}'; expected UCHAR, CHAR, USHORT, SHORT, UINT, "
                               "INT, FLOAT or DOUBLE",
                               quotable(entry.value)));
}

bool parse_endianness(const Entry* entry) {
  if (entry == nullptr || lower_case(entry->value) == "little") return false;
  if (lower_case(entry->value) == "big") return true;
  throw core::InputError(
      entry->place,
      fmt::format("unknown endianness '{}'; expected LITTLE or BIG", quotable(entry->value)));
}

// Some programs misspell the key as "endianess".
const Entry* endianness_in(const Description& description) {
  const Entry* right = description.find("endianness");
  const Entry* wrong = description.find("endianess");
  if (right != nullptr && wrong != nullptr) {
    throw core::InputError(wrong->place,
                           "the byte order is specified twice, as Endianness and "
                           "as Endianess");
  }
  return right != nullptr ? right : wrong;
}

}  // namespace

Volume read_dat(const std::filesystem::path& file, const Component& component) {
  const Description description(file);
  const Entry& resolution = description.require("resolution", "Resolution");
  const Entry& data = description.require("objectfilename", "ObjectFileName");
  Volume volume;
  volume.size = parse_sizes(resolution.value, resolution.place);
  if (const Entry* spacing = description.find("slicethickness")) {
    volume.spacing = parse_spacings(spacing->value, volume.size, spacing->place);
  }
  RawVoxels source;
  source.file = find_data_file(file, data.value, data.place);
  source.layout.type = parse_format(description.require("format", "Format"));
  source.layout.big_endian = parse_endianness(endianness_in(description));
  source.component = component;
  source.sizes_place = resolution.place;
  read_voxels(volume, source);
  return volume;
}

}  // namespace triptych::scene
