#include "scene/nrrd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "scene/header_fields.hpp"
#include "scene/nrrd_axes.hpp"
#include "scene/nrrd_files.hpp"
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

bool parse_big_endian(const Header& header, const RawVoxels& source) {
  const Field* field = header.find("endian");
  if (field == nullptr) {
    if (bytes_of(source.layout.type) == 1 || source.encoding == RawEncoding::text) return false;
    throw core::InputError(header.require("type").place,
                           "multi-byte values require the field 'endian'");
  }
  const std::string name = lower_case(field->value);
  if (name == "little") return false;
  if (name == "big") return true;
  throw core::InputError(
      field->place,
      fmt::format("unknown byte order '{}'; expected little or big", quotable(field->value)));
}

}  // namespace

Volume read_nrrd(const std::filesystem::path& file, const Component& component) {
  const Header header(file);
  Volume volume;
  ValueLayout layout;
  layout.type = parse_type(header.require("type"));
  const nrrd::ComponentAxis component_axis = nrrd::parse_axes(header, volume, layout);
  nrrd::parse_spacing(header, component_axis, volume);
  volume.facts.unit = nrrd::unit_of(header);
  RawVoxels source = nrrd::locate(header, file);
  source.layout = layout;
  source.layout.big_endian = parse_big_endian(header, source);
  source.component = component;
  read_voxels(volume, source);
  return volume;
}

}  // namespace triptych::scene
