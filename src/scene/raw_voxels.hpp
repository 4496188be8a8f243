#pragma once
// Reads the voxels that a header describes into a volume, and decodes them if necessary.

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "scene/compression.hpp"
#include "scene/volume.hpp"
#include "scene/voxel_values.hpp"

namespace triptych::scene {

enum class RawEncoding : std::uint8_t { plain, gzip, zlib, bzip2, text, hex };

struct RawVoxels {
  static constexpr std::int64_t at_end = -1;

  std::filesystem::path file;
  // Further files with voxels that follow those in `file`. Each contains as many voxels as `file`.
  std::vector<std::filesystem::path> more_files = {};
  Packing packing = Packing::none;  // compression of the file
  std::uint64_t start = 0;  // offset of the data in the decompressed file, before any bytes to skip
  // The number of bytes to skip before the voxels in the decoded stream. at_end means that the
  // voxels are the last bytes of the stream.
  std::int64_t skip = 0;
  RawEncoding encoding = RawEncoding::plain;
  ValueLayout layout = {};
  Component component = {};
  bool more_may_follow = false;      // false: data after the voxels are an error
  core::FilePlace sizes_place = {};  // where the header states the sizes, for errors
};

// Fills volume.voxels, whose size must already be set, and sets the volume's type, its facts, and
// its range from the finite voxels (0..0 if no voxel is finite). Only one copy of the voxels exists
// in memory. For an uncompressed file, memory is allocated only after the file is known to be long
// enough. For a compressed file, memory is used as the voxels are decompressed. Throws InputError
// if the data are shorter or longer than size and type require or if a compressed stream is
// damaged, and IoError if the file cannot be read.
void read_voxels(Volume& volume, const RawVoxels& source);

// Like read_voxels(), but reads values that are already decoded, and allows further data after
// them. Throws InputError if the volume needs more than most_unpacked_bytes.
void read_stream(Volume& volume, const ValueLayout& layout, const Component& component,
                 const ByteSource& values, const std::filesystem::path& file);

// Parse parts of a header that occur in all formats. Errors name `place`.
[[nodiscard]] std::array<int, 3> parse_sizes(std::string_view text, const core::FilePlace& place);
[[nodiscard]] std::array<double, 3> parse_spacings(std::string_view text,
                                                   const std::array<int, 3>& size,
                                                   const core::FilePlace& place);
// Returns the spacing if it is usable, and throws InputError otherwise. A spacing must be positive
// and finite, and neither the spacing nor the length of all `size` voxels along its axis may be
// near the limits of single precision.
[[nodiscard]] double usable_spacing(double spacing, int size, const core::FilePlace& place);

// Returns the path of a file that a header names relative to the header's folder. Throws InputError
// if the file does not exist.
[[nodiscard]] std::filesystem::path find_data_file(const std::filesystem::path& header,
                                                   std::string_view name,
                                                   const core::FilePlace& place);

}  // namespace triptych::scene
