#pragma once
// Parses FILE:SIZE:TYPE, which names a file of voxels without a header and describes its contents.

#include <optional>
#include <string>
#include <string_view>

#include "scene/volume.hpp"
#include "scene/voxel_values.hpp"

namespace triptych::scene {

// A description such as "FILE:256x256x128:u8". The type may be followed by options in any order:
// the spacing (":1x1x2.5"), "big" or "little" (the default), "skip=BYTES" for bytes before the
// voxels, and "components=N" for the number of consecutive values per voxel. Types are u8 i8 u16
// i16 u32 i32 u64 i64 f32 f64, or their NumPy names (such as uint8 and float32).
struct RawSpec {
  std::string file;
  std::array<int, 3> size{};
  std::array<double, 3> spacing{1, 1, 1};
  ValueLayout layout;
  std::int64_t skip = 0;
};

// Returns nullopt if `data` does not state a size. Throws InputError for an invalid description.
[[nodiscard]] std::optional<RawSpec> parse_raw_spec(std::string_view data);

[[nodiscard]] Volume read_raw(const RawSpec& spec, const std::filesystem::path& file,
                              const Component& component);

}  // namespace triptych::scene
