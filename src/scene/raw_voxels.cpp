#include "scene/raw_voxels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "scene/inflate.hpp"
#include "scene/scalar_dispatch.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

std::optional<std::uint64_t> byte_count(const Volume& volume) {
  std::uint64_t bytes = bytes_of(volume.type);
  for (const int n : volume.size) {
    const auto factor = static_cast<std::uint64_t>(n);
    if (bytes > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) / factor) {
      return std::nullopt;
    }
    bytes *= factor;
  }
  return bytes;
}

std::string stated(const Volume& volume) {
  return fmt::format("{} x {} x {} voxels of {}", volume.size[0], volume.size[1], volume.size[2],
                     name_of(volume.type));
}

class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& file)
      : name_(file.string()), in_(file, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(file, error);
    if (!in_ || error) throw core::IoError(name_ + ": cannot be read");
  }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  void seek(std::uint64_t place) { in_.seekg(static_cast<std::streamoff>(place)); }
  // Returns how many bytes were there.
  std::size_t read(std::span<std::byte> bytes) {
    in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (in_.bad()) throw core::IoError(name_ + ": reading failed");
    return static_cast<std::size_t>(in_.gcount());
  }

 private:
  std::string name_;
  std::ifstream in_;
  std::uint64_t size_ = 0;
};

void read_plain(Volume& volume, const RawVoxels& source, std::uint64_t needed, InputFile& file) {
  const std::uint64_t there = file.size() - std::min(source.start, file.size());
  const bool from_end = source.skip == RawVoxels::at_end;
  const std::uint64_t skipped = from_end ? there - std::min(needed, there)
                                         : std::min(static_cast<std::uint64_t>(source.skip), there);
  const std::uint64_t available = there - skipped;
  if (available != needed) {
    throw core::InputError(
        source.sizes_place,
        fmt::format("{} need {} bytes of data, but {} holds {}{}", stated(volume), needed,
                    source.file.filename().string(), available,
                    available > needed ? " (data after the end)" : " (truncated)"));
  }
  file.seek(source.start + skipped);
  volume.voxels.resize(needed);
  if (file.read(volume.voxels) != needed) {
    throw core::IoError(fmt::format("{}: became shorter while it was read", source.file.string()));
  }
}

// Room is set aside for all of them, so that none is copied, but taken only as they come: a claim
// alone costs no memory.
std::size_t inflate_into(VoxelBytes& voxels, std::uint64_t needed, Inflater& inflater) {
  constexpr std::uint64_t piece = std::uint64_t{16} << 20;
  voxels.reserve(needed);
  for (;;) {
    const std::size_t before = voxels.size();
    voxels.resize(before + std::min(piece, needed - before));
    const std::size_t got = inflater.read(std::span(voxels).subspan(before));
    if (before + got < voxels.size() || voxels.size() == needed) return before + got;
  }
}

void read_gzip(Volume& volume, const RawVoxels& source, std::uint64_t needed, InputFile& file) {
  // Deflate's densest code spends one bit on 129 bytes; more cannot come out of this file.
  constexpr std::uint64_t largest_ratio = 1032;
  const std::uint64_t there = file.size() - std::min(source.start, file.size());
  const auto skip = static_cast<std::uint64_t>(source.skip);
  if ((needed + skip) / largest_ratio > there) {
    throw core::InputError(
        source.sizes_place,
        fmt::format("{} need {} bytes of data, more than the {} compressed bytes "
                    "of {} can hold",
                    stated(volume), needed, there, source.file.filename().string()));
  }
  if (needed > most_unpacked_bytes || skip > most_unpacked_bytes - needed) {
    refuse_unpacked(source.file.string(), most_unpacked_bytes);
  }
  file.seek(source.start);
  Inflater inflater([&file](std::span<std::byte> bytes) { return file.read(bytes); },
                    source.file.string());
  inflater.skip(skip);
  const std::size_t filled = inflate_into(volume.voxels, needed, inflater);
  if (filled != needed) {
    throw core::InputError(
        source.sizes_place,
        fmt::format("{} need {} bytes of data, but the gzip stream in {} holds {}", stated(volume),
                    needed, source.file.filename().string(), filled));
  }
  std::byte surplus{};
  if (inflater.read({&surplus, 1}) != 0) {
    throw core::InputError(
        source.sizes_place,
        fmt::format("{} need {} bytes of data, but the gzip stream in {} holds more",
                    stated(volume), needed, source.file.filename().string()));
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

}  // namespace

void read_voxels(Volume& volume, const RawVoxels& source) {
  const auto needed = byte_count(volume);
  if (!needed) {
    throw core::InputError(source.sizes_place,
                           stated(volume) + " are more bytes than a 64-bit number can count");
  }
  InputFile file(source.file);
  if (source.encoding == RawEncoding::gzip) {
    read_gzip(volume, source, *needed, file);
  } else {
    read_plain(volume, source, *needed, file);
  }
  if (source.big_endian != (std::endian::native == std::endian::big)) {
    swap_bytes(volume.voxels, bytes_of(volume.type));
  }
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
                           fmt::format("spacing {} of {} voxels; expected a box of lengths from {} "
                                       "to {}, which single precision can hold",
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

std::filesystem::path data_file_beside(const std::filesystem::path& header, std::string_view name,
                                       const core::FilePlace& place) {
  const std::filesystem::path file = header.parent_path() / std::filesystem::path(name);
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(file, unreadable)) {
    throw core::InputError(place, fmt::format("the data file '{}' is not there", quotable(name)));
  }
  return file;
}

}  // namespace triptych::scene
