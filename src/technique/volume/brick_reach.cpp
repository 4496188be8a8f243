#include "technique/volume/brick_reach.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace triptych::technique {
namespace {

class ReachGrid {
 public:
  ReachGrid(const std::array<int, 3>& counts, std::span<const std::uint32_t> visible)
      : counts_(counts), visible_(visible), reach_(visible.size(), std::ranges::max(counts)) {}

  // Shortens the reach of the brick (x, y, z) according to 13 of its neighbours: the neighbours
  // before it in memory order (side −1) or after it (side +1).
  void relax(int x, int y, int z, int side) {
    const std::size_t centre = index(x, y, z);
    for (int neighbour = 1; neighbour <= 13; ++neighbour) {
      // In a block of 27 bricks, numbered with x fastest, brick 13 is the brick itself, and bricks
      // 14 to 26 come after it.
      const int n = neighbour + 13;
      const int i = x + side * (n % 3 - 1);
      const int j = y + side * (n / 3 % 3 - 1);
      const int k = z + side * (n / 9 - 1);
      if (i < 0 || j < 0 || k < 0 || i >= counts_[0] || j >= counts_[1] || k >= counts_[2]) {
        continue;
      }
      const std::size_t other = index(i, j, k);
      const bool same_visibility = visible_[other] == visible_[centre];
      reach_[centre] = std::min(reach_[centre], same_visibility ? reach_[other] + 1 : 1);
    }
  }

  [[nodiscard]] std::vector<std::int32_t> signed_reach() && {
    for (std::size_t b = 0; b < reach_.size(); ++b) {
      if (visible_[b] == 0) reach_[b] = -reach_[b];
    }
    return std::move(reach_);
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    return size(x) + size(counts_[0]) * (size(y) + size(counts_[1]) * size(z));
  }

  std::array<int, 3> counts_;
  std::span<const std::uint32_t> visible_;
  std::vector<std::int32_t> reach_;
};

}  // namespace

// These are the two passes of a chamfer distance transform (Rosenfeld & Pfaltz 1966), which is
// exact for Chebyshev distances.
std::vector<std::int32_t> brick_reach(const std::array<int, 3>& counts,
                                      std::span<const std::uint32_t> visible) {
  ReachGrid grid(counts, visible);
  const auto [nx, ny, nz] = counts;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) grid.relax(x, y, z, -1);
    }
  }
  for (int z = nz - 1; z >= 0; --z) {
    for (int y = ny - 1; y >= 0; --y) {
      for (int x = nx - 1; x >= 0; --x) grid.relax(x, y, z, 1);
    }
  }
  return std::move(grid).signed_reach();
}

}  // namespace triptych::technique
