#pragma once
// From the values of a file to the voxels of a volume: one component of several, or its magnitude,
// scaled if the file states a scale, in one of the types that Volume has.

#include <cstdint>
#include <optional>
#include <string_view>

#include "scene/inflate.hpp"
#include "scene/volume.hpp"

namespace triptych::scene {

// Types of values in files. Volume has no 32- and 64-bit integers: they become the smallest type
// that holds all values of the file exactly (u8, i8, u16, i16, f32), else f64.
enum class StoredType : std::uint8_t { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };
[[nodiscard]] std::size_t bytes_of(StoredType type);
[[nodiscard]] std::string_view name_of(StoredType type);
// The type of a volume's voxels that stores these values as they are; nothing where none does.
[[nodiscard]] std::optional<ScalarType> same_type(StoredType type);

// How the values of a file follow one another. Voxels come with x fastest.
struct ValueLayout {
  StoredType type = StoredType::u8;
  bool big_endian = false;
  std::uint64_t components = 1;  // values for each voxel
  // How many voxels' values of one component stand together: 1 where the components of a voxel do,
  // all voxels where one component's volume follows the other.
  std::uint64_t block = 1;
  double slope = 1;  // value = slope·stored + intercept
  double intercept = 0;

  [[nodiscard]] bool is_scaled() const { return slope != 1 || intercept != 0; }
};

// Whether the voxels are the file's bytes, but for their order within a value.
[[nodiscard]] bool is_plain(const ValueLayout& layout);

// Reads all values of a volume, whose size is set, and fills its voxels and its type. Memory is
// taken as they come. Returns how many bytes were there, which are fewer than value_bytes only where
// the source ended too early.
[[nodiscard]] std::uint64_t take_values(Volume& volume, const ValueLayout& layout,
                                        const Component& component, const ByteSource& source);

// The number of bytes of a volume's values in the file; nothing if 64 bits cannot count them.
[[nodiscard]] std::optional<std::uint64_t> value_bytes(const Volume& volume,
                                                       const ValueLayout& layout);

// Throws InputError for a component that the file does not have.
void check_component(const Component& component, std::uint64_t components,
                     const std::filesystem::path& file);

}  // namespace triptych::scene
