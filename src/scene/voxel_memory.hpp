#pragma once
// Memory for voxels. It is on the heap or, for large volumes, in an unnamed file, so that the
// operating system can write parts of it to disk if memory is short.

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace triptych::scene {

// Voxels of this size or more are stored in a file. The system can write the file's pages back to
// disk, and they do not count towards the limit on a process's data segment.
inline constexpr std::size_t least_bytes_in_a_file = std::size_t{512} << 20U;

// Returns zero-filled memory. Throws std::bad_alloc, or IoError if the folder for the file (TMPDIR
// or /var/tmp) has no space.
[[nodiscard]] void* allocate_voxels(std::size_t bytes);
void free_voxels(void* voxels, std::size_t bytes) noexcept;

template <typename T>
struct VoxelAllocator {
  using value_type = T;

  [[nodiscard]] T* allocate(std::size_t n) {
    return static_cast<T*>(allocate_voxels(n * sizeof(T)));
  }
  void deallocate(T* voxels, std::size_t n) noexcept { free_voxels(voxels, n * sizeof(T)); }
  // Memory that resize() adds is already zero. Initializing it again would write the whole file
  // twice.
  template <typename U>
  void construct(U* /*fresh*/) noexcept {}
  template <typename U, typename... From>
  void construct(U* at, From&&... from) {
    ::new (static_cast<void*>(at)) U(std::forward<From>(from)...);
  }
  bool operator==(const VoxelAllocator&) const = default;
};

// A vector for voxels. It must only grow, because a resize() after shrinking would expose old
// values instead of zeros.
using VoxelBytes = std::vector<std::byte, VoxelAllocator<std::byte>>;

}  // namespace triptych::scene
