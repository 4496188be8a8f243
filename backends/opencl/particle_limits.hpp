#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "backends/opencl/objects.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// Where entries of bins are counted: by each work item that takes a chunk of the cells, for each
// bin.
struct BinTable {
  std::size_t bins = 0;  // a picture's tiles, and the coarse ones
  std::size_t chunks = 0;

  [[nodiscard]] std::size_t words() const { return bins * chunks; }
};
// A chunk for some particles each, so that many compute units have work; fewer where the table
// would be larger than what it is to sort. The scene alone decides: the bytes that a frame takes
// belong to no machine.
[[nodiscard]] BinTable bin_table(int width, int height, std::size_t particles);

// Why the device cannot draw these particles so; empty when it can.
[[nodiscard]] std::optional<std::string> particle_defect(const Session& session,
                                                         std::string_view technique,
                                                         const measure::ParticleWork& work);

}  // namespace triptych::opencl_backend
