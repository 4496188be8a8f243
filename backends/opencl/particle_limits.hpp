#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "backends/opencl/objects.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// The table that counts the entries of bins. It has a number for each work item, which processes a
// chunk of the cells, and each bin.
struct BinTable {
  std::size_t bins = 0;  // the number of tiles and coarse tiles of an image
  std::size_t chunks = 0;

  [[nodiscard]] std::size_t words() const { return bins * chunks; }
};
// Chunks are so small that many compute units have work, but larger if the table would otherwise be
// larger than the entries that it is used to sort. Only the scene decides their number, so that the
// bytes that a frame allocates are the same on every machine and can be compared with a baseline.
// Few compute units could do with fewer chunks: with two of them, the 390 chunks of
// stress:pile:200000 take 24,304 bytes more than 16 would.
[[nodiscard]] BinTable bin_table(int width, int height, std::size_t particles);

// The reason why the device cannot draw these particles with this technique; empty if it can.
[[nodiscard]] std::optional<std::string> particle_defect(const Session& session,
                                                         std::string_view technique,
                                                         const measure::ParticleWork& work);

}  // namespace triptych::opencl_backend
