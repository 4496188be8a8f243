#pragma once
// Volumes as read from a file or generated (Volume), and as uploaded to a device (VoxelGrid).

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/read_facts.hpp"
#include "scene/voxel_memory.hpp"

namespace triptych::scene {

enum class ScalarType : std::uint8_t { u8, i8, u16, i16, f32, f64 };
[[nodiscard]] std::size_t bytes_of(ScalarType type);
[[nodiscard]] std::string_view name_of(ScalarType type);

// How a value v in a range [lo, hi] is mapped to 0..1: x = (t(v) − t(lo))/(t(hi) − t(lo)), with
// t(v) = v or ln v.
enum class Mapping : std::uint8_t { linear, logarithmic };
[[nodiscard]] std::string_view name_of(Mapping mapping);

// A scalar field on a regular grid. Values are stored as in the file, but in native byte order,
// with x fastest: voxel (i, j, k) is element i + nx·(j + ny·k). Voxel centres are at (i+½)·spacing,
// and the volume fills [0, size·spacing] in world units. Outside the outermost centres, the field
// has the value of the nearest edge.
struct Volume {
  std::string name;  // the factor (setting) `data`: a file name or generate:NAME:SIZE
  std::array<int, 3> size{};
  std::array<double, 3> spacing{1, 1, 1};
  ScalarType type = ScalarType::u8;
  VoxelBytes voxels;
  // The values that are mapped to 0 and 1, the ends of the transfer function. For a file, these are
  // the minimum and maximum of the finite voxels. A generator sets its own range. lo == hi is
  // allowed, in which case every voxel maps to 0.
  double range_lo = 0;
  double range_hi = 1;
  Mapping mapping = Mapping::linear;
  bool clipped = false;  // some values are outside the range (see set_window())
  // An interval that contains the normalised values of all voxels. It is smaller than [0, 1] only
  // if set_window() has found that the voxels use a part of the window, and if all of them are
  // finite.
  std::array<double, 2> used{0, 1};
  ReadFacts facts;  // facts about the file

  [[nodiscard]] std::size_t voxel_count() const noexcept;
  // Returns a value as stored in the file, which may be NaN or infinite.
  [[nodiscard]] double value(std::size_t index) const;
};

// The format in which voxels are stored on a device. The formats are the levels (values) of the
// factor `voxel`.
enum class VoxelFormat : std::uint8_t { u8, u16, f32, f16 };
[[nodiscard]] std::string_view name_of(VoxelFormat format);
[[nodiscard]] VoxelFormat voxel_format(std::string_view name);  // throws InputError
[[nodiscard]] std::size_t bytes_of(VoxelFormat format);
// Returns the largest integer that u8 or u16 can store. Returns 1 for float formats, whose texels
// contain the stored value itself.
[[nodiscard]] double largest_stored(VoxelFormat format);

// Voxels as uploaded to a device. The normalised value, which is 0..1 over the range, is
//   x = stored·scale + offset     (stored: the integer, or the float itself)
// - u8 and u16 store integers of up to 8 and 16 bits exactly, regardless of their range, if the
//   mapping is linear and no value is clamped. Otherwise they store x, rounded to a multiple of
//   1/255 or 1/65535.
// - f32 stores x itself, clamped to [0, 1], with NaN as 0.
// - f16 stores halves ≥ 0, none of which is subnormal. They are the integers of a file minus the
//   lower end of the range (rounded down), if halves represent these differences exactly (see
//   fits_halves()). Otherwise they are 2¹⁵·x, rounded, and x below 2⁻²⁹ becomes 0. Therefore no
//   voxel overflows, and it does not matter how a device treats subnormals.
struct VoxelGrid {
  VoxelFormat format = VoxelFormat::f32;
  std::array<int, 3> size{};
  std::array<double, 3> spacing{1, 1, 1};
  VoxelBytes data;
  double scale = 1;
  double offset = 0;
  double range_lo = 0;
  double range_hi = 1;
  Mapping mapping = Mapping::linear;  // how values are mapped to x; x is always linear in `stored`
  std::string name;
  std::string hash;  // content hash of the voxels and how they are mapped to x

  [[nodiscard]] std::size_t voxel_count() const noexcept;
  [[nodiscard]] double normalised(std::size_t index) const;  // x of this voxel
};

// Returns the smallest format that represents every value of this type exactly. For f64, returns
// f32, although f32 is not exact.
[[nodiscard]] VoxelFormat lossless_format(ScalarType type);
// Returns the smallest lossless format for the mapped volume: f32 if integers are clamped or mapped
// logarithmically.
[[nodiscard]] VoxelFormat lossless_format(const Volume& volume);

// Returns whether f16 represents every voxel exactly. This is the case for integers with a linear
// mapping and no clamped value if each of them has at most 11 significant bits after the lower end
// of the range (rounded down) has been subtracted.
[[nodiscard]] bool fits_halves(const Volume& volume);

// Converts the volume to a format. If the format cannot represent the values exactly, they are
// quantized over the range. If the volume's type already has the representation of the format, its
// voxels are moved, so that only one copy exists in memory.
[[nodiscard]] VoxelGrid encode(Volume&& volume, VoxelFormat format);

// The value that is drawn for voxels with several values, as selected by the factor `component`.
struct Component {
  std::uint64_t index = 0;  // 0-based
  bool magnitude = false;   // draw the Euclidean length of all values instead
};
// Parses a level such as "2" or "magnitude". Throws InputError.
[[nodiscard]] Component parse_component(std::string_view text);

// Loads a volume. `data` has the same form as in a plan (a file that defines the configurations to
// measure): "generate:NAME:SIZE" or "generate:NAME:NXxNYxNZ" (scene/generators.hpp), a file in one
// of the formats in scene/volume_formats.hpp, or "FILE:NXxNYxNZ:TYPE" for voxels without a header
// (scene/raw_spec.hpp). A relative file name is first looked up in the working directory, and then
// in each of `folders`. Throws InputError with file and line, and IoError if the file does not
// exist.
[[nodiscard]] Volume load_volume(std::string_view data,
                                 const std::vector<std::filesystem::path>& folders = {},
                                 const Component& component = {});

// Throws the same exceptions as load_volume() if `data` names a volume that cannot be generated,
// but does not generate it. Does not check files.
void check_generated_volume(std::string_view data);

// Returns whether `data` can be loaded: false for a file that does not exist on this machine.
[[nodiscard]] bool is_present(std::string_view data,
                              const std::vector<std::filesystem::path>& folders = {});

}  // namespace triptych::scene
