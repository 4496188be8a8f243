#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "backends/opencl/objects.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// The table that counts the entries of bins. A bin is a tile or a coarse tile, and its entries are
// the particles that overlap it. The table has one number for each pair of a bin and a work item.
// Each work item processes one chunk (a range) of the cells, which are ranges of neighbouring
// particles.
struct BinTable {
  std::size_t bins = 0;  // the number of tiles and coarse tiles of an image
  std::size_t chunks = 0;

  [[nodiscard]] std::size_t words() const { return bins * chunks; }
};
// Chunks are small, so that many compute units have work, but not so small that the table becomes
// larger than the entries that it helps to sort. The number of chunks depends only on the scene, so
// that a frame allocates the same number of bytes on every machine, and this number can be compared
// with a baseline. On devices with few compute units, fewer chunks would suffice. For example, the
// 390 chunks of the scene stress:pile:200000 need 24,304 more bytes than 16 chunks would.
[[nodiscard]] BinTable bin_table(int width, int height, std::size_t particles);

// Returns the reason why the device cannot draw these particles with this technique; nullopt if it
// can.
[[nodiscard]] std::optional<std::string> particles_unsupported(const Session& session,
                                                               std::string_view technique,
                                                               const measure::ParticleWork& work);

}  // namespace triptych::opencl_backend
