#include "scene/raw_voxels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "scene/inflate.hpp"
#include "scene/scalar_dispatch.hpp"
#include "scene/text_lines.hpp"
#include "scene/voxel_encodings.hpp"

namespace triptych::scene {
namespace {

std::string voxels_text(const Volume& volume, const RawVoxels& source) {
  const std::string components =
      source.layout.components == 1 ? "" : fmt::format("{} x ", source.layout.components);
  return fmt::format("{} x {} x {} voxels of {}{}", volume.size[0], volume.size[1], volume.size[2],
                     components, name_of(source.layout.type));
}

std::uint64_t size_of_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) throw core::IoError(file.string() + ": the file cannot be read");
  return size;
}

// Returns the name that messages use for the stream of voxels, or an empty string for plain data.
std::string_view stream_name(const RawVoxels& source) {
  switch (source.encoding) {
    case RawEncoding::gzip:
      return "the gzip stream in ";
    case RawEncoding::zlib:
      return "the zlib stream in ";
    case RawEncoding::bzip2:
      return "the bzip2 stream in ";
    case RawEncoding::text:
      return "the text in ";
    case RawEncoding::hex:
      return "the hexadecimal text in ";
    case RawEncoding::plain:
      break;
  }
  return source.packing == Packing::none ? "" : "the compressed stream in ";
}

[[noreturn]] void refuse_size(const Volume& volume, const RawVoxels& source, std::uint64_t needed,
                              const std::filesystem::path& file, const std::string& found) {
  throw core::InputError(
      source.sizes_place,
      fmt::format("{} need {} bytes of data, but {}{} holds {}", voxels_text(volume, source),
                  needed, stream_name(source), file.filename().string(), found));
}

bool is_compressed(const RawVoxels& source) {
  return source.packing != Packing::none || source.encoding == RawEncoding::gzip ||
         source.encoding == RawEncoding::zlib || source.encoding == RawEncoding::bzip2;
}

// Returns the decoded bytes of one of the files, including the bytes to be skipped.
ByteSource open_data(const RawVoxels& source, const std::filesystem::path& file) {
  const std::string name = file.string();
  ByteSource bytes;
  if (source.packing == Packing::none) {
    bytes = file_bytes(file, source.start);
  } else {
    bytes = unpacked(file_bytes(file), source.packing, name);
    skip_bytes(bytes, source.start);
  }
  switch (source.encoding) {
    case RawEncoding::gzip:
      return unpacked(std::move(bytes), Packing::gzip, name);
    case RawEncoding::zlib: {
      const auto inflater =
          std::make_shared<Inflater>(std::move(bytes), name, Wrapper::gzip_or_zlib);
      return [inflater](std::span<std::byte> out) { return inflater->read(out); };
    }
    case RawEncoding::bzip2:
      return unpacked(std::move(bytes), Packing::bzip2, name);
    case RawEncoding::text:
      return text_values(std::move(bytes), source.layout.type, name);
    case RawEncoding::hex:
      return hex_bytes(std::move(bytes), name);
    case RawEncoding::plain:
      break;
  }
  return bytes;
}

// Returns the number of bytes before the voxels in a file that contains `share` bytes of voxels.
std::uint64_t bytes_before(const RawVoxels& source, const std::filesystem::path& file,
                           std::uint64_t share) {
  if (source.skip != RawVoxels::at_end) return static_cast<std::uint64_t>(source.skip);
  const std::uint64_t all =
      skip_bytes(open_data(source, file), std::numeric_limits<std::uint64_t>::max());
  return all - std::min(share, all);
}

// Checks that a file is long enough for the voxels that its header claims. This happens before
// memory is allocated.
void check_claim(const Volume& volume, const RawVoxels& source, std::uint64_t needed,
                 std::uint64_t share, const std::filesystem::path& file) {
  const std::uint64_t size = size_of_file(file);
  const std::uint64_t present_bytes =
      source.packing == Packing::none ? size - std::min(source.start, size) : size;
  const auto skip = static_cast<std::uint64_t>(std::max<std::int64_t>(source.skip, 0));
  if (is_compressed(source)) {
    // Deflate expands one bit to at most 129 bytes, which limits the decompressed size. bzip2 has
    // no useful limit.
    constexpr std::uint64_t largest_ratio = 1032;
    const bool deflated = source.encoding != RawEncoding::bzip2 && source.packing != Packing::bzip2;
    if (deflated && (share + skip) / largest_ratio > present_bytes) {
      throw core::InputError(
          source.sizes_place,
          fmt::format(
              "{} need {} bytes of data, more than the {} compressed bytes of {} can contain",
              voxels_text(volume, source), needed, present_bytes, file.filename().string()));
    }
    if (needed > most_unpacked_bytes || skip > most_unpacked_bytes - needed) {
      refuse_unpacked(file.string(), most_unpacked_bytes);
    }
    return;
  }
  // In a text file, a value has at least one character, and a separator precedes the next value.
  const bool text = source.encoding == RawEncoding::text;
  const bool hex = source.encoding == RawEncoding::hex;
  const std::uint64_t least = text  ? share / bytes_of(source.layout.type) * 2 - 1
                              : hex ? share * 2
                                    : share;
  if (least > present_bytes || skip > present_bytes - least) {
    const std::uint64_t found = present_bytes - std::min(skip, present_bytes);
    refuse_size(volume, source, needed, file, fmt::format("{} (truncated)", found));
  }
}

// The bytes of the voxels of all files, concatenated.
class Files {
 public:
  Files(const Volume& volume, const RawVoxels& source, std::uint64_t needed)
      : volume_(volume), source_(source), needed_(needed) {
    files_.push_back(source.file);
    files_.insert(files_.end(), source.more_files.begin(), source.more_files.end());
    share_ = needed / files_.size();
    if (share_ * files_.size() != needed) {
      throw core::InputError(
          source.sizes_place,
          fmt::format("{} need {} bytes of data, which cannot be divided equally "
                      "among {} files",
                      voxels_text(volume, source), needed, files_.size()));
    }
    for (const auto& file : files_) check_claim(volume, source, needed, share_, file);
    open();
  }

  std::size_t read(std::span<std::byte> out) {
    std::size_t filled = 0;
    while (filled < out.size()) {
      if (left_ == 0) {
        if (index_ + 1 == files_.size()) break;
        check_surplus();
        ++index_;
        open();
      }
      const auto wanted =
          static_cast<std::size_t>(std::min<std::uint64_t>(out.size() - filled, left_));
      const std::size_t got = bytes_(out.subspan(filled, wanted));
      filled += got;
      left_ -= got;
      if (got < wanted) refuse_short();
    }
    return filled;
  }

  // Checks that nothing follows the values in the current file, except blanks in a text file.
  void check_surplus() const {
    if (source_.more_may_follow) return;
    std::vector<std::byte> surplus(
        source_.encoding == RawEncoding::text ? bytes_of(source_.layout.type) : std::size_t{1});
    if (bytes_(surplus) == 0) return;
    const bool plain = stream_name(source_).empty();
    refuse_size(volume_, source_, needed_, files_[index_],
                plain ? "more (data after the end)" : "more");
  }

 private:
  void open() {
    const std::uint64_t before = bytes_before(source_, files_[index_], share_);
    bytes_ = open_data(source_, files_[index_]);
    skip_bytes(bytes_, before);
    left_ = share_;
  }

  [[noreturn]] void refuse_short() const {
    const std::uint64_t found = share_ - left_;
    refuse_size(volume_, source_, files_.size() == 1 ? needed_ : share_, files_[index_],
                fmt::format("{}{}", found, stream_name(source_).empty() ? " (truncated)" : ""));
  }

  const Volume& volume_;
  const RawVoxels& source_;
  std::uint64_t needed_;
  std::uint64_t share_ = 0;
  std::vector<std::filesystem::path> files_;
  std::size_t index_ = 0;
  std::uint64_t left_ = 0;
  ByteSource bytes_;
};

// Reads a single uncompressed file whose bytes are exactly the voxels, in one read.
void read_plain(Volume& volume, const RawVoxels& source, std::uint64_t needed) {
  const std::uint64_t size = size_of_file(source.file);
  const std::uint64_t present_bytes = size - std::min(source.start, size);
  const bool from_end = source.skip == RawVoxels::at_end;
  const std::uint64_t skipped =
      from_end ? present_bytes - std::min(needed, present_bytes)
               : std::min(static_cast<std::uint64_t>(source.skip), present_bytes);
  const std::uint64_t available = present_bytes - skipped;
  const bool enough = source.more_may_follow ? available >= needed : available == needed;
  if (!enough) {
    refuse_size(volume, source, needed, source.file,
                fmt::format("{}{}", available,
                            available > needed ? " (data after the end)" : " (truncated)"));
  }
  const ByteSource bytes = file_bytes(source.file, source.start + skipped);
  volume.voxels.resize(needed);
  if (bytes(volume.voxels) != needed) {
    throw core::IoError(
        fmt::format("{}: the file became shorter while it was read", source.file.string()));
  }
}

// Reads voxels that need no conversion (see is_plain()). Address space is reserved for all voxels
// at once, so that the vector never has to copy them. The operating system provides memory only as
// voxels are read, so a header that claims too many voxels does not cost memory.
void read_unconverted(VoxelBytes& voxels, std::uint64_t needed, Files& files) {
  constexpr std::uint64_t piece = std::uint64_t{16} << 20;
  voxels.reserve(needed);
  while (voxels.size() < needed) {
    const std::size_t before = voxels.size();
    voxels.resize(before + std::min(piece, needed - before));
    static_cast<void>(files.read(std::span(voxels).subspan(before)));
  }
}

void swap_bytes(VoxelBytes& voxels, std::size_t width) {
  for (std::size_t i = 0; i < voxels.size(); i += width) {
    std::reverse(voxels.data() + i, voxels.data() + i + width);
  }
}

void set_finite_range(Volume& volume) {
  with_scalar_type(volume.type, [&](auto zero) {
    using Scalar = decltype(zero);
    double lo = std::numeric_limits<double>::infinity();
    double hi = -lo;
    for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
      const auto value = static_cast<double>(load_scalar<Scalar>(volume.voxels.data(), i));
      if (!std::isfinite(value)) continue;
      lo = std::min(lo, value);
      hi = std::max(hi, value);
    }
    volume.range_lo = lo <= hi ? lo : 0;
    volume.range_hi = lo <= hi ? hi : 0;
  });
}

void note_values(Volume& volume, const RawVoxels& source) {
  const ValueLayout& layout = source.layout;
  ReadFacts& facts = volume.facts;
  facts.value_type = name_of(layout.type);
  facts.components = layout.components;
  if (layout.is_scaled()) {
    facts.notes.push_back(fmt::format("the stored values are scaled: value = {}·stored + {}",
                                      layout.slope, layout.intercept));
  }
  if (layout.components == 1) return;
  facts.notes.push_back(
      source.component.magnitude
          ? fmt::format("the magnitude of the {} components of each voxel is drawn",
                        layout.components)
          : fmt::format("only component {} of the {} components of each voxel is drawn; use the "
                        "factor `component` to draw another component or the magnitude",
                        source.component.index, layout.components));
}

}  // namespace

void read_voxels(Volume& volume, const RawVoxels& given) {
  RawVoxels source = given;
  ValueLayout& layout = source.layout;
  // The reader of text files returns numbers in the byte order of this machine, whatever the header
  // states.
  if (source.encoding == RawEncoding::text) {
    layout.big_endian = std::endian::native == std::endian::big;
  }
  const auto needed = value_bytes(volume, layout);
  if (!needed) {
    throw core::InputError(
        source.sizes_place,
        voxels_text(volume, source) + " need more bytes than a 64-bit integer can represent");
  }
  check_component(source.component, layout.components, source.file);
  const bool plain = is_plain(layout) && !source.component.magnitude;
  const bool at_once = plain && source.encoding == RawEncoding::plain &&
                       source.packing == Packing::none && source.more_files.empty();
  if (plain) volume.type = *same_type(layout.type);
  if (at_once) {
    read_plain(volume, source, *needed);
  } else {
    Files files(volume, source, *needed);
    if (plain) {
      read_unconverted(volume.voxels, *needed, files);
    } else {
      static_cast<void>(read_values(volume, layout, source.component,
                                    [&](std::span<std::byte> out) { return files.read(out); }));
    }
    files.check_surplus();
  }
  if (plain && layout.big_endian != (std::endian::native == std::endian::big)) {
    swap_bytes(volume.voxels, bytes_of(volume.type));
  }
  note_values(volume, source);
  set_finite_range(volume);
}

void read_stream(Volume& volume, const ValueLayout& layout, const Component& component,
                 const ByteSource& values, const std::filesystem::path& file) {
  const RawVoxels source{.file = file,
                         .layout = layout,
                         .component = component,
                         .sizes_place = {.file = file.string()}};
  const auto needed = value_bytes(volume, layout);
  check_component(component, layout.components, file);
  if (!needed || *needed > most_unpacked_bytes) {
    throw core::InputError(source.sizes_place,
                           fmt::format("{} need more than {} bytes, the size limit for this "
                                       "format; convert larger volumes to NRRD",
                                       voxels_text(volume, source), most_unpacked_bytes));
  }
  const std::uint64_t found = read_values(volume, layout, component, values);
  if (found < *needed) {
    refuse_size(volume, source, *needed, file, fmt::format("{} (truncated)", found));
  }
  note_values(volume, source);
  set_finite_range(volume);
}

std::array<int, 3> parse_sizes(std::string_view text, const core::FilePlace& place) {
  const auto words = split_words(text);
  if (words.size() != 3) {
    throw core::InputError(place, fmt::format("expected 3 sizes, got {}", words.size()));
  }
  std::array<int, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto n = parse_number<int>(words[axis]);
    if (!n || *n < 1) {
      throw core::InputError(
          place, fmt::format("size '{}' along axis {}; expected a whole number from 1 to {}",
                             quotable(words[axis]), axis, std::numeric_limits<int>::max()));
    }
    size.at(axis) = *n;
  }
  return size;
}

double usable_spacing(double spacing, int size, const core::FilePlace& place) {
  constexpr double shortest = 1e-30;
  constexpr double longest = 1e30;
  if (!(spacing > 0 && std::isfinite(spacing))) {
    throw core::InputError(place,
                           fmt::format("spacing {}; expected a positive, finite number", spacing));
  }
  if (spacing < shortest || spacing * size > longest) {
    throw core::InputError(place,
                           fmt::format("spacing {} is out of range for an axis of {} voxels; the "
                                       "spacing and the axis length must be between {} and {}, so "
                                       "that they can be stored in single precision",
                                       spacing, size, shortest, longest));
  }
  return spacing;
}

std::array<double, 3> parse_spacings(std::string_view text, const std::array<int, 3>& size,
                                     const core::FilePlace& place) {
  const auto words = split_words(text);
  if (words.size() != 3) {
    throw core::InputError(place, fmt::format("expected 3 spacings, got {}", words.size()));
  }
  std::array<double, 3> spacing{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = parse_number<double>(words[axis]);
    if (!value) {
      throw core::InputError(place, fmt::format("spacing '{}'; expected a positive, finite number",
                                                quotable(words[axis])));
    }
    spacing.at(axis) = usable_spacing(*value, size.at(axis), place);
  }
  return spacing;
}

std::filesystem::path find_data_file(const std::filesystem::path& header, std::string_view name,
                                     const core::FilePlace& place) {
  const std::filesystem::path file = header.parent_path() / std::filesystem::path(name);
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(file, unreadable)) {
    throw core::InputError(place, fmt::format("the data file '{}' does not exist", quotable(name)));
  }
  return file;
}

}  // namespace triptych::scene
