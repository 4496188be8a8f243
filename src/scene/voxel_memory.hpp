#pragma once
// The memory for voxels: on the heap or, for large volumes, in an unnamed file, of which the
// operating system keeps in memory as much as there is room for.

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace triptych::scene {

// From this size on, voxels are stored in a file. The system can write its pages back, and it does
// not count towards a limit on the data of a process.
inline constexpr std::size_t least_bytes_in_a_file = std::size_t{512} << 20U;

// Returns memory filled with 0. Throws std::bad_alloc, and for a file IoError if its folder
// (TMPDIR, or /var/tmp) has no space.
[[nodiscard]] void* allocate_voxels(std::size_t bytes);
void free_voxels(void* voxels, std::size_t bytes) noexcept;

template <typename T>
struct VoxelAllocator {
  using value_type = T;

  [[nodiscard]] T* allocate(std::size_t n) {
    return static_cast<T*>(allocate_voxels(n * sizeof(T)));
  }
  void deallocate(T* voxels, std::size_t n) noexcept { free_voxels(voxels, n * sizeof(T)); }
  // Memory that resize() adds is already 0. Writing it again would fill a file twice.
  template <typename U>
  void construct(U* /*fresh*/) noexcept {}
  template <typename U, typename... From>
  void construct(U* at, From&&... from) {
    ::new (static_cast<void*>(at)) U(std::forward<From>(from)...);
  }
  bool operator==(const VoxelAllocator&) const = default;
};

// Must only grow: if it was made smaller, a later resize() shows the old values instead of 0.
using VoxelBytes = std::vector<std::byte, VoxelAllocator<std::byte>>;

}  // namespace triptych::scene
