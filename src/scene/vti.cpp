#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
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
#include "scene/voxel_encodings.hpp"
#include "scene/vtk_image.hpp"
#include "scene/xml_tags.hpp"

namespace triptych::scene {
namespace {

struct VtiArray {
  XmlTag tag;
  bool is_cell_data = false;
};

// The tags that were found in a file.
struct VtiFile {
  std::string file;
  XmlTag root;
  XmlTag image;
  std::vector<XmlTag> pieces;
  std::vector<VtiArray> arrays;
  // The names of the arrays that are declared as point scalars and as cell scalars.
  std::array<std::string, 2> active;
  std::optional<XmlTag> appended;
  std::uint64_t appended_start = 0;  // the position after the '_'

  [[noreturn]] void reject(const std::string& message) const {
    throw core::InputError({.file = file}, message);
  }
};

// Returns the position after the '_' that precedes the appended data.
std::uint64_t start_of_appended(const std::filesystem::path& file, std::uint64_t from) {
  const ByteSource source = content_bytes(file);
  skip_bytes(source, from);
  std::array<std::byte, 64> bytes{};
  const std::size_t got = source(bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), got);
  const std::size_t mark = text.find_first_not_of(" \t\r\n");
  if (mark == std::string_view::npos || text[mark] != '_') {
    throw core::InputError({.file = file.string()}, "expected '_' before the appended data");
  }
  return from + mark + 1;
}

VtiFile read_tags(const std::filesystem::path& file) {
  VtiFile vti{.file = file.string(), .root = {}, .image = {}, .appended = {}};
  XmlTags tags(content_bytes(file), vti.file);
  int part = -1;  // 0: point data, 1: cell data, -1: neither
  while (const auto tag = tags.next()) {
    if (tag->name == "VTKFile") {
      vti.root = *tag;
    } else if (tag->name == "ImageData") {
      vti.image = *tag;
    } else if (tag->name == "Piece") {
      vti.pieces.push_back(*tag);
    } else if (tag->name == "PointData" || tag->name == "CellData") {
      part = tag->name == "PointData" ? 0 : 1;
      vti.active.at(static_cast<std::size_t>(part)) =
          tag->attribute("Scalars", tag->attribute("Vectors"));
      if (tag->empty) part = -1;
    } else if (tag->name == "/PointData" || tag->name == "/CellData") {
      part = -1;
    } else if (tag->name == "DataArray" && part >= 0) {
      vti.arrays.push_back({*tag, part == 1});
    } else if (tag->name == "AppendedData") {
      vti.appended = *tag;
      vti.appended_start = start_of_appended(file, tag->end);
      break;  // binary data follow, not tags
    }
  }
  if (vti.root.attribute("type") != "ImageData" || vti.image.name.empty()) {
    vti.reject("expected <VTKFile type=\"ImageData\"> with <ImageData>");
  }
  if (vti.pieces.size() > 1) {
    vti.reject(
        fmt::format("the file has {} pieces; expected one (in ParaView, use the filter Merge "
                    "Blocks or Resample To Image)",
                    vti.pieces.size()));
  }
  if (vti.arrays.empty()) {
    vti.reject("the file contains no data; expected <Piece> with <PointData> and a <DataArray>");
  }
  return vti;
}

// Returns the array to draw: the point scalars, or else the cell scalars, or else the first point
// array, or else the first cell array.
const VtiArray& chosen_array(const VtiFile& vti) {
  for (const bool by_name : {true, false}) {
    for (const bool is_cell_data : {false, true}) {
      const std::string& active = vti.active.at(is_cell_data ? 1 : 0);
      for (const VtiArray& array : vti.arrays) {
        if (array.is_cell_data != is_cell_data) continue;
        if (!by_name || (!active.empty() && array.tag.attribute("Name") == active)) return array;
      }
    }
  }
  return vti.arrays.front();
}

template <typename T>
std::vector<T> numbers_of(const std::string& text, std::size_t count, const VtiFile& vti,
                          std::string_view name) {
  std::string plain = text;
  std::ranges::replace(plain, '\n', ' ');
  std::vector<T> numbers;
  for (const std::string_view word : split_words(plain)) {
    const auto number = parse_number<T>(word);
    if (!number) vti.reject(fmt::format("{}: '{}' is not a number", name, quotable(word)));
    numbers.push_back(*number);
  }
  if (numbers.size() != count) {
    vti.reject(fmt::format("{}: expected {} numbers, got {}", name, count, numbers.size()));
  }
  return numbers;
}

void set_extent(const VtiFile& vti, bool is_cell_data, Volume& volume) {
  const auto extent = numbers_of<int>(vti.image.attribute("WholeExtent"), 6, vti, "WholeExtent");
  if (!vti.pieces.empty()) {
    const std::string piece = vti.pieces.front().attribute("Extent");
    if (!piece.empty() && numbers_of<int>(piece, 6, vti, "Extent") != extent) {
      vti.reject("the piece does not contain the whole image (Extent and WholeExtent differ)");
    }
  }
  const auto spacing =
      numbers_of<double>(vti.image.attribute("Spacing", "1 1 1"), 3, vti, "Spacing");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t size =
        std::int64_t{extent[2 * axis + 1]} - extent[2 * axis] + (is_cell_data ? 0 : 1);
    if (size < 1 || size > std::numeric_limits<int>::max()) {
      vti.reject(
          fmt::format("WholeExtent has {} values along axis {}; expected at least 1", size, axis));
    }
    volume.size.at(axis) = static_cast<int>(size);
    volume.spacing.at(axis) =
        usable_spacing(spacing.at(axis), volume.size.at(axis), {.file = vti.file});
  }
  const std::string direction = vti.image.attribute("Direction");
  if (direction.empty()) return;
  const auto d = numbers_of<double>(direction, 9, vti, "Direction");
  std::array<Vector3, 3> axes{};
  for (std::size_t i = 0; i < 9; ++i) axes.at(i % 3).at(i / 3) = d[i];
  if (const std::string sheared = sheared_axes(axes); !sheared.empty()) {
    vti.reject(fmt::format("{} are not perpendicular; sheared grids are not supported", sheared));
  }
}

StoredType vti_type(const VtiFile& vti, const XmlTag& array) {
  static constexpr std::array<std::pair<std::string_view, StoredType>, 10> types{
      {{"UInt8", StoredType::u8},
       {"Int8", StoredType::i8},
       {"UInt16", StoredType::u16},
       {"Int16", StoredType::i16},
       {"UInt32", StoredType::u32},
       {"Int32", StoredType::i32},
       {"UInt64", StoredType::u64},
       {"Int64", StoredType::i64},
       {"Float32", StoredType::f32},
       {"Float64", StoredType::f64}}};
  const std::string name = array.attribute("type");
  for (const auto& [spelling, type] : types) {
    if (name == spelling) return type;
  }
  vti.reject(fmt::format("type '{}' is not supported; expected Int8 to UInt64, Float32 or Float64",
                         quotable(name)));
}

// Reads the numbers that precede the data. Each has 4 or 8 bytes, in the file's byte order.
class BlockHeader {
 public:
  BlockHeader(const VtiFile& vti, const ByteSource& source)
      : vti_(vti),
        source_(source),
        wide_(vti.root.attribute("header_type", "UInt32") == "UInt64"),
        big_(vti.root.attribute("byte_order") == "BigEndian") {}

  [[nodiscard]] std::uint64_t take() const {
    std::array<std::byte, 8> bytes{};
    const auto used = std::span(bytes).first(wide_ ? 8 : 4);
    if (source_(used) != used.size()) vti_.reject("the data end in the middle of the block header");
    if (big_ == (std::endian::native == std::endian::little)) std::ranges::reverse(used);
    if (!wide_) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data(), sizeof(value));
      return value;
    }
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data(), sizeof(value));
    return value;
  }

 private:
  const VtiFile& vti_;
  const ByteSource& source_;
  bool wide_;
  bool big_;
};

// Reads zlib-compressed blocks, which follow a header with their sizes.
class ZlibBlocks {
 public:
  ZlibBlocks(const VtiFile& vti, ByteSource source) : file_(vti.file), source_(std::move(source)) {
    constexpr std::uint64_t most_blocks = std::uint64_t{1} << 24U;
    constexpr std::uint64_t largest = std::uint64_t{1} << 30U;
    const BlockHeader header(vti, source_);
    const std::uint64_t count = header.take();
    size_ = header.take();
    const std::uint64_t last = header.take();
    if (count > most_blocks || size_ > largest || last > size_ || (count > 0 && size_ == 0)) {
      vti.reject(
          fmt::format("invalid block sizes: {} blocks of {} bytes, with a last block of {} bytes",
                      count, size_, last));
    }
    last_ = last == 0 ? size_ : last;
    for (std::uint64_t i = 0; i < count; ++i) packed_.push_back(header.take());
  }

  std::size_t operator()(std::span<std::byte> out) {
    std::size_t filled = 0;
    while (filled < out.size()) {
      if (at_ == block_.size() && !next_block()) break;
      const std::size_t piece = std::min(out.size() - filled, block_.size() - at_);
      std::memcpy(out.data() + filled, block_.data() + at_, piece);
      at_ += piece;
      filled += piece;
    }
    return filled;
  }

 private:
  bool next_block() {
    if (next_ == packed_.size()) return false;
    const std::uint64_t packed_size = packed_[next_++];
    const std::uint64_t size = next_ == packed_.size() ? last_ : size_;
    // compressBound() is zlib's upper limit for the compressed size of a block of this size.
    if (packed_size > compressBound(static_cast<uLong>(size)) + 64) {
      reject(fmt::format("the compressed size of {} bytes is too large for a block of {} bytes",
                         packed_size, size));
    }
    input_.resize(static_cast<std::size_t>(packed_size));
    if (source_(input_) != input_.size()) reject("the data end prematurely");
    block_.resize(static_cast<std::size_t>(size));
    auto unpacked = static_cast<uLongf>(size);
    const int code =
        uncompress(reinterpret_cast<Bytef*>(block_.data()), &unpacked,
                   reinterpret_cast<const Bytef*>(input_.data()), static_cast<uLong>(packed_size));
    if (code != Z_OK || unpacked != size) reject(fmt::format("block {} is damaged", next_ - 1));
    at_ = 0;
    return true;
  }

  [[noreturn]] void reject(const std::string& reason) const {
    throw core::InputError({.file = file_}, "broken zlib blocks: " + reason);
  }

  std::string file_;
  ByteSource source_;
  std::uint64_t size_ = 0;
  std::uint64_t last_ = 0;
  std::vector<std::uint64_t> packed_;
  std::size_t next_ = 0;
  std::vector<std::byte> input_;
  std::vector<std::byte> block_;
  std::size_t at_ = 0;
};

// Returns a source of the array's values, which begins at the first value.
ByteSource open_array(const VtiFile& vti, const XmlTag& array, const std::filesystem::path& file,
                      StoredType type) {
  const std::string format = array.attribute("format", "ascii");
  ByteSource bytes = content_bytes(file);
  if (format == "ascii") {
    skip_bytes(bytes, array.end);
    return text_values(std::move(bytes), type, vti.file);
  }
  bool base64 = true;
  if (format == "appended") {
    const auto offset = parse_number<std::uint64_t>(array.attribute("offset", "0"));
    if (!vti.appended || !offset) vti.reject("expected <AppendedData> and an offset into it");
    skip_bytes(bytes, vti.appended_start);
    skip_bytes(bytes, *offset);
    base64 = vti.appended->attribute("encoding", "base64") != "raw";
  } else if (format == "binary") {
    skip_bytes(bytes, array.end);
  } else {
    vti.reject(fmt::format("format '{}' is not supported; expected ascii, binary or appended",
                           quotable(format)));
  }
  if (base64) bytes = base64_bytes(std::move(bytes), vti.file);
  const std::string compressor = vti.root.attribute("compressor");
  if (compressor.empty()) {
    const BlockHeader header(vti, bytes);
    // The header contains only the number of bytes. It is skipped, because this number also follows
    // from the size of the volume and the type of its values.
    static_cast<void>(header.take());
    return bytes;
  }
  if (compressor != "vtkZLibDataCompressor") {
    vti.reject(
        fmt::format("compressor '{}' is not supported; expected vtkZLibDataCompressor or none; in "
                    "ParaView, save the file with the compressor ZLib or None",
                    quotable(compressor)));
  }
  const auto blocks = std::make_shared<ZlibBlocks>(vti, std::move(bytes));
  return [blocks](std::span<std::byte> out) { return (*blocks)(out); };
}

}  // namespace

Volume read_vti(const std::filesystem::path& file, const Component& component) {
  const VtiFile vti = read_tags(file);
  const VtiArray& array = chosen_array(vti);
  Volume volume;
  set_extent(vti, array.is_cell_data, volume);
  ValueLayout layout;
  layout.type = vti_type(vti, array.tag);
  const std::string components = array.tag.attribute("NumberOfComponents", "1");
  const auto count = parse_number<std::uint32_t>(components);
  if (!count || *count == 0) {
    vti.reject(fmt::format("NumberOfComponents is '{}'; expected a whole number, 1 or more",
                           quotable(components)));
  }
  layout.components = *count;
  const bool text = array.tag.attribute("format", "ascii") == "ascii";
  layout.big_endian = text ? std::endian::native == std::endian::big
                           : vti.root.attribute("byte_order") == "BigEndian";
  if (vti.arrays.size() > 1) {
    volume.facts.notes.push_back(
        fmt::format("only the array '{}' is drawn, although the file contains {} arrays",
                    quotable(array.tag.attribute("Name")), vti.arrays.size()));
  }
  read_stream(volume, layout, component, open_array(vti, array.tag, file, layout.type), file);
  return volume;
}

}  // namespace triptych::scene
