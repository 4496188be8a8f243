#pragma once
// Converts the values in a file to the voxels of a volume: selects one of several components, or
// computes their magnitude, and applies the scale that the file states. The result has one of the
// scalar types of Volume.

#include <cstdint>
#include <optional>
#include <string_view>

#include "scene/inflate.hpp"
#include "scene/volume.hpp"

namespace triptych::scene {

// The types of values in files. Volume has no 32-bit and 64-bit integers. They are converted to the
// smallest type that represents all values of the file exactly (u8, i8, u16, i16, f32), or else to
// f64.
enum class StoredType : std::uint8_t { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };
[[nodiscard]] std::size_t bytes_of(StoredType type);
[[nodiscard]] std::string_view name_of(StoredType type);
// Returns the voxel type that stores these values unchanged, or nullopt if there is none.
[[nodiscard]] std::optional<ScalarType> same_type(StoredType type);

// The order of the values in a file. In each component, x varies fastest.
struct ValueLayout {
  StoredType type = StoredType::u8;
  bool big_endian = false;
  std::uint64_t components = 1;  // number of values per voxel
  // The number of consecutive values of the same component. It is 1 if the components of a voxel
  // are consecutive, or the number of voxels if each component is stored as a separate volume.
  std::uint64_t block = 1;
  double slope = 1;  // value = slope·stored + intercept
  double intercept = 0;

  [[nodiscard]] bool is_scaled() const { return slope != 1 || intercept != 0; }
};

// Returns whether the voxels are exactly the file's bytes, apart from the byte order within a
// value.
[[nodiscard]] bool is_plain(const ValueLayout& layout);

// Reads all values of a volume whose size is set, and sets its voxels and its type. Memory is used
// as values are read. Returns the number of bytes read, which is less than value_bytes() only if
// the source ended too early.
[[nodiscard]] std::uint64_t read_values(Volume& volume, const ValueLayout& layout,
                                        const Component& component, const ByteSource& source);

// Returns the number of bytes of the volume's values in the file, or nullopt if the number exceeds
// 64 bits.
[[nodiscard]] std::optional<std::uint64_t> value_bytes(const Volume& volume,
                                                       const ValueLayout& layout);

// Throws InputError if the file does not have this component.
void check_component(const Component& component, std::uint64_t components,
                     const std::filesystem::path& file);

}  // namespace triptych::scene
