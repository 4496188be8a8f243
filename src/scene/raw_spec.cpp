#include "scene/raw_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "scene/compression.hpp"
#include "scene/raw_voxels.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view form =
    "FILE:NXxNYxNZ:TYPE, for example head.raw:256x256x128:u8, optionally followed by the spacing "
    "(:1x1x2.5), :big, :skip=BYTES or :components=N";

constexpr std::array<std::pair<std::string_view, StoredType>, 20> type_names{
    {{"u8", StoredType::u8},       {"i8", StoredType::i8},      {"u16", StoredType::u16},
     {"i16", StoredType::i16},     {"u32", StoredType::u32},    {"i32", StoredType::i32},
     {"u64", StoredType::u64},     {"i64", StoredType::i64},    {"f32", StoredType::f32},
     {"f64", StoredType::f64},     {"uint8", StoredType::u8},   {"int8", StoredType::i8},
     {"uint16", StoredType::u16},  {"int16", StoredType::i16},  {"uint32", StoredType::u32},
     {"int32", StoredType::i32},   {"uint64", StoredType::u64}, {"int64", StoredType::i64},
     {"float32", StoredType::f32}, {"float64", StoredType::f64}}};

[[noreturn]] void reject_spec(std::string_view data, std::string_view reason) {
  throw core::InputError(fmt::format("'{}': {}; expected {}", data, reason, form));
}

template <typename Number>
std::optional<std::array<Number, 3>> three_numbers(std::string_view text) {
  std::array<Number, 3> numbers{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t end = std::min(text.find('x'), text.size());
    const auto number = parse_number<Number>(text.substr(0, end));
    if (!number || (end == text.size()) != (axis == 2)) return std::nullopt;
    numbers.at(axis) = *number;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return numbers;
}

std::vector<std::string_view> parts_of(std::string_view data) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = data.find(':');
    parts.push_back(data.substr(0, end));
    if (end == std::string_view::npos) return parts;
    data.remove_prefix(end + 1);
  }
}

// Parses an option that follows the type.
void parse_option(RawSpec& spec, std::string_view part, std::string_view data) {
  constexpr std::string_view skip = "skip=";
  constexpr std::string_view components = "components=";
  if (part == "big" || part == "little") {
    spec.layout.big_endian = part == "big";
  } else if (part.starts_with(skip)) {
    const auto bytes = parse_number<std::int64_t>(part.substr(skip.size()));
    if (!bytes || *bytes < 0) reject_spec(data, "'skip' must be a whole number, 0 or more");
    spec.skip = *bytes;
  } else if (part.starts_with(components)) {
    const auto count = parse_number<std::uint64_t>(part.substr(components.size()));
    if (!count || *count < 1) reject_spec(data, "'components' must be a whole number, 1 or more");
    spec.layout.components = *count;
  } else if (const auto spacing = three_numbers<double>(part)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      spec.spacing.at(axis) =
          usable_spacing(spacing->at(axis), spec.size.at(axis), {.file = spec.file});
    }
  } else {
    reject_spec(data, fmt::format("'{}' is neither a spacing nor an option", part));
  }
}

}  // namespace

std::optional<RawSpec> parse_raw_spec(std::string_view data) {
  const std::vector<std::string_view> parts = parts_of(data);
  // The file's name may contain colons, so it ends before the first part that is a size.
  std::size_t at = 1;
  while (at < parts.size() && !three_numbers<int>(parts[at])) ++at;
  if (at >= parts.size()) return std::nullopt;
  RawSpec spec;
  const auto length = static_cast<std::size_t>(parts[at].data() - data.data());
  spec.file = data.substr(0, length - 1);
  spec.size = *three_numbers<int>(parts[at]);
  if (std::ranges::any_of(spec.size, [](int n) { return n < 1; })) {
    reject_spec(data, "each size must be at least 1");
  }
  if (at + 1 == parts.size()) reject_spec(data, "the type is missing");
  const auto type = std::ranges::find(type_names, lower_case(parts[at + 1]),
                                      &std::pair<std::string_view, StoredType>::first);
  if (type == type_names.end()) {
    reject_spec(data,
                fmt::format("unknown type '{}'; expected u8 i8 u16 i16 u32 i32 u64 i64 f32 or f64",
                            parts[at + 1]));
  }
  spec.layout.type = type->second;
  for (std::size_t i = at + 2; i < parts.size(); ++i) parse_option(spec, parts[i], data);
  return spec;
}

Volume read_raw(const RawSpec& spec, const std::filesystem::path& file,
                const Component& component) {
  Volume volume;
  volume.size = spec.size;
  volume.spacing = spec.spacing;
  // Raw voxels may happen to begin with the same bytes as a compressed file. Therefore the file is
  // checked for compression only if its name ends in .gz or .bz2.
  const bool packed = file.extension() == ".gz" || file.extension() == ".bz2";
  read_voxels(volume, {.file = file,
                       .packing = packed ? packing_of_file(file) : Packing::none,
                       .skip = spec.skip,
                       .layout = spec.layout,
                       .component = component,
                       .sizes_place = {.file = file.string()}});
  volume.facts.format = "raw voxels";
  return volume;
}

}  // namespace triptych::scene
