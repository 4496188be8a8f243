#pragma once
// Where voxels lie: on the heap, or, where they are many, in an unnamed file of which the system
// holds in memory what there is room for.

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace triptych::scene {

// From this many bytes on in a file. Its pages can go, and no limit on a process' data counts them.
inline constexpr std::size_t least_bytes_in_a_file = std::size_t{512} << 20U;

// Bytes of 0. Throws std::bad_alloc, and of a file IoError where its folder, TMPDIR or else
// /var/tmp, has no room.
[[nodiscard]] void* allocate_voxels(std::size_t bytes);
void free_voxels(void* voxels, std::size_t bytes) noexcept;

template <typename T>
struct VoxelAllocator {
  using value_type = T;

  [[nodiscard]] T* allocate(std::size_t n) {
    return static_cast<T*>(allocate_voxels(n * sizeof(T)));
  }
  void deallocate(T* voxels, std::size_t n) noexcept { free_voxels(voxels, n * sizeof(T)); }
  // What resize() adds is 0 as it comes: to write that again would fill a file twice.
  template <typename U>
  void construct(U* /*fresh*/) noexcept {}
  template <typename U, typename... From>
  void construct(U* at, From&&... from) {
    ::new (static_cast<void*>(at)) U(std::forward<From>(from)...);
  }
  bool operator==(const VoxelAllocator&) const = default;
};

// Grows only: bytes that were given up keep what they held.
using VoxelBytes = std::vector<std::byte, VoxelAllocator<std::byte>>;

}  // namespace triptych::scene
