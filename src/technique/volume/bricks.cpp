#include "technique/volume/bricks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych::technique {
namespace {

struct Span {
  int begin;
  int end;
};

// Voxels of brick b along an axis of n voxels, with the one-voxel border.
Span with_border(int b, int n) {
  return {std::max(0, b * brick_edge - 1), std::min(n, (b + 1) * brick_edge + 1)};
}

}  // namespace

std::array<int, 3> brick_counts(const std::array<int, 3>& size) {
  std::array<int, 3> counts{};
  std::ranges::transform(size, counts.begin(),
                         [](int n) { return (n + brick_edge - 1) / brick_edge; });
  return counts;
}

BrickRanges brick_ranges(const scene::VoxelGrid& grid) {
  BrickRanges ranges{.counts = brick_counts(grid.size), .minimum = {}, .maximum = {}};
  const auto [bx, by, bz] = ranges.counts;
  const std::size_t count =
      static_cast<std::size_t>(bx) * static_cast<std::size_t>(by) * static_cast<std::size_t>(bz);
  ranges.minimum.reserve(count);
  ranges.maximum.reserve(count);
  const auto nx = static_cast<std::size_t>(grid.size[0]);
  const auto ny = static_cast<std::size_t>(grid.size[1]);
  for (int z = 0; z < bz; ++z) {
    for (int y = 0; y < by; ++y) {
      for (int x = 0; x < bx; ++x) {
        double lo = std::numeric_limits<double>::infinity();
        double hi = -lo;
        const Span xs = with_border(x, grid.size[0]);
        const Span ys = with_border(y, grid.size[1]);
        const Span zs = with_border(z, grid.size[2]);
        for (int k = zs.begin; k < zs.end; ++k) {
          for (int j = ys.begin; j < ys.end; ++j) {
            const std::size_t row =
                nx * (static_cast<std::size_t>(j) + ny * static_cast<std::size_t>(k));
            for (int i = xs.begin; i < xs.end; ++i) {
              const double value = grid.normalised(row + static_cast<std::size_t>(i));
              lo = std::min(lo, value);
              hi = std::max(hi, value);
            }
          }
        }
        ranges.minimum.push_back(static_cast<float>(lo));
        ranges.maximum.push_back(static_cast<float>(hi));
      }
    }
  }
  return ranges;
}

std::vector<std::uint32_t> brick_visibility(const BrickRanges& ranges,
                                            const scene::TransferFunction& function) {
  constexpr int entries = 256;
  // opaque_before[k]: how many of the entries before k have any opacity.
  std::array<int, entries + 1> opaque_before{};
  for (int k = 0; k < entries; ++k) {
    const auto index = static_cast<std::size_t>(k);
    opaque_before[index + 1] = opaque_before[index] + (function.entries[index][3] > 0 ? 1 : 0);
  }
  const auto entry_below = [](float value) {
    return static_cast<int>(std::floor(static_cast<double>(value) * entries - 0.5));
  };
  std::vector<std::uint32_t> visible(ranges.minimum.size());
  for (std::size_t b = 0; b < visible.size(); ++b) {
    const int first = std::clamp(entry_below(ranges.minimum[b]) - 1, 0, entries - 1);
    const int last = std::clamp(entry_below(ranges.maximum[b]) + 2, 0, entries - 1);
    visible[b] = opaque_before[static_cast<std::size_t>(last) + 1] >
                         opaque_before[static_cast<std::size_t>(first)]
                     ? 1U
                     : 0U;
  }
  return visible;
}

}  // namespace triptych::technique
