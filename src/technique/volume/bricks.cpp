#include "technique/volume/bricks.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <span>

namespace triptych::technique {
namespace {

struct Span {
  int begin;
  int end;
};

// Returns the range of voxels of brick b, including its border, along an axis with n voxels.
Span with_border(int b, int n, const BrickLayout& layout) {
  return {std::max(0, b * layout.edge - layout.border),
          std::min(n, (b + 1) * layout.edge + layout.border + (layout.is_cell_aligned ? 1 : 0))};
}

struct Range {
  float minimum = std::numeric_limits<float>::infinity();
  float maximum = -std::numeric_limits<float>::infinity();

  // Widens the range. A NaN has no effect.
  void widen(const Range& by) {
    minimum = std::min(minimum, by.minimum);
    maximum = std::max(maximum, by.maximum);
  }
};

// Merges the value ranges of voxels into the value ranges of bricks, along one axis. `from`
// contains `stride` adjacent ranges for each of the `lines` voxel positions along the axis. `to`
// contains `stride` ranges for each of the `bricks` brick positions.
void gather(std::span<const Range> from, std::size_t stride, int lines, int bricks,
            const BrickLayout& layout, std::span<Range> to) {
  for (int b = 0; b < bricks; ++b) {
    const Span span = with_border(b, lines, layout);
    for (int line = span.begin; line < span.end; ++line) {
      for (std::size_t i = 0; i < stride; ++i) {
        to[static_cast<std::size_t>(b) * stride + i].widen(
            from[static_cast<std::size_t>(line) * stride + i]);
      }
    }
  }
}

// Merges the voxels of one slice into bricks along x and y.
std::vector<Range> slice_ranges(const scene::VoxelGrid& grid, const BrickLayout& layout,
                                const std::array<int, 3>& bricks, int slice) {
  const auto nx = static_cast<std::size_t>(grid.size[0]);
  const auto ny = static_cast<std::size_t>(grid.size[1]);
  const auto bx = static_cast<std::size_t>(bricks[0]);
  std::vector<Range> voxels(nx);
  std::vector<Range> rows(bx * ny);
  for (std::size_t j = 0; j < ny; ++j) {
    const std::size_t first = nx * (j + ny * static_cast<std::size_t>(slice));
    for (std::size_t i = 0; i < nx; ++i) {
      const auto value = static_cast<float>(grid.normalised(first + i));
      voxels[i] = {value, value};
    }
    gather(voxels, 1, grid.size[0], bricks[0], layout, std::span(rows).subspan(bx * j, bx));
  }
  std::vector<Range> result(bx * static_cast<std::size_t>(bricks[1]));
  gather(rows, bx, grid.size[1], bricks[1], layout, result);
  return result;
}

// Calls visit(range) for every brick (x fastest) until it returns false. The ranges are merged axis
// by axis, so that the cost of a wide border is proportional to its width and not to the cube of
// its width.
template <typename Visit>
void visit_bricks(const scene::VoxelGrid& grid, const BrickLayout& layout, Visit visit) {
  const std::array<int, 3> bricks = brick_counts(grid.size, layout);
  const int nz = grid.size[2];
  std::deque<std::vector<Range>> open;  // layers of bricks that are not complete yet
  int first = 0;                        // index of the first open layer
  for (int k = 0; k < nz; ++k) {
    const std::vector<Range> slice = slice_ranges(grid, layout, bricks, k);
    const auto next = [&] { return first + static_cast<int>(open.size()); };
    while (next() < bricks[2] && with_border(next(), nz, layout).begin <= k) {
      open.emplace_back(slice.size());
    }
    for (std::vector<Range>& layer : open) {
      for (std::size_t b = 0; b < slice.size(); ++b) layer[b].widen(slice[b]);
    }
    for (; !open.empty() && with_border(first, nz, layout).end == k + 1; ++first) {
      if (!std::ranges::all_of(open.front(), visit)) return;
      open.pop_front();
    }
  }
}

// Determines whether a transfer function assigns any opacity to a range of values. A prefix sum
// makes each query O(1).
class OpaqueRanges {
 public:
  explicit OpaqueRanges(const scene::TransferFunction& function) {
    for (std::size_t k = 0; k < entries; ++k) {
      opaque_before_[k + 1] = opaque_before_[k] + (function.entries[k][3] > 0 ? 1 : 0);
    }
  }

  // Returns whether any value in the range, widened by one table entry on each side, has any
  // opacity.
  [[nodiscard]] bool touches(const Range& range) const {
    const std::size_t first = entry(range.minimum, -1);
    const std::size_t last = entry(range.maximum, 2);
    return opaque_before_[last + 1] > opaque_before_[first];
  }

 private:
  static constexpr int entries = 256;

  // Returns the index of the last entry whose centre is not above the value, plus `beyond`, clamped
  // to the table.
  [[nodiscard]] static std::size_t entry(float value, int beyond) {
    const int below = static_cast<int>(std::floor(static_cast<double>(value) * entries - 0.5));
    return static_cast<std::size_t>(std::clamp(below + beyond, 0, entries - 1));
  }

  std::array<int, entries + 1> opaque_before_{};  // [k]: number of opaque entries before entry k
};

// The largest buffer, in bytes, that every Vulkan device can bind (the required minimum of
// maxStorageBufferRange).
constexpr std::uint64_t most_map_bytes = 1U << 27U;

BrickLayout bricks_of_cells(const std::array<int, 3>& size) {
  BrickLayout layout{.edge = 2, .border = 0, .is_cell_aligned = true};
  while (brick_map_bytes(size, layout) > most_map_bytes) layout.edge *= 2;
  return layout;
}

}  // namespace

BrickLayout brick_layout(const scene::VolumeScene& scene, Skip skip, double adapt) {
  BrickLayout layout;
  const bool cells = scene.quadrature == scene::Quadrature::cells;
  if (skip == Skip::distance) layout = bricks_of_cells(scene.grid->size);
  if (cells) layout = {.edge = layout.edge, .border = 0, .is_cell_aligned = true};
  if (adapt > 0 && scene.shading.enabled) layout.border += 1;
  if (scene.quadrature == scene::Quadrature::preintegrated) {
    const double half = scene.step_voxels / 2;
    const double farther = layout.is_cell_aligned ? std::ceil(half) : std::floor(half + 0.75);
    // A border need not be wider than the volume.
    const int longest = std::max({scene.grid->size[0], scene.grid->size[1], scene.grid->size[2]});
    layout.border += static_cast<int>(std::min(farther, static_cast<double>(longest)));
  }
  return layout;
}

std::array<int, 3> brick_counts(const std::array<int, 3>& size, const BrickLayout& layout) {
  std::array<int, 3> counts{};
  std::ranges::transform(size, counts.begin(), [&](int n) {
    const int length = layout.is_cell_aligned ? std::max(n - 1, 1) : n;
    return (length + layout.edge - 1) / layout.edge;
  });
  return counts;
}

std::uint64_t brick_map_bytes(const std::array<int, 3>& size, const BrickLayout& layout) {
  std::uint64_t bytes = sizeof(std::int32_t);
  for (const int n : brick_counts(size, layout)) bytes *= static_cast<std::uint64_t>(n);
  return bytes;
}

BrickRanges brick_ranges(const scene::VoxelGrid& grid, const BrickLayout& layout) {
  BrickRanges ranges{.counts = brick_counts(grid.size, layout), .minimum = {}, .maximum = {}};
  std::size_t count = 1;
  for (const int n : ranges.counts) count *= static_cast<std::size_t>(n);
  ranges.minimum.reserve(count);
  ranges.maximum.reserve(count);
  visit_bricks(grid, layout, [&](const Range& range) {
    ranges.minimum.push_back(range.minimum);
    ranges.maximum.push_back(range.maximum);
    return true;
  });
  return ranges;
}

std::vector<std::uint32_t> brick_visibility(const BrickRanges& ranges,
                                            const scene::TransferFunction& function) {
  const OpaqueRanges opaque(function);
  std::vector<std::uint32_t> visible(ranges.minimum.size());
  for (std::size_t b = 0; b < visible.size(); ++b) {
    visible[b] = opaque.touches({ranges.minimum[b], ranges.maximum[b]}) ? 1U : 0U;
  }
  return visible;
}

bool any_brick_is_empty(const scene::VolumeScene& scene, const BrickLayout& layout) {
  const OpaqueRanges opaque(scene.transfer_function);
  bool all_visible = true;
  visit_bricks(*scene.grid, layout, [&](const Range& range) {
    all_visible = opaque.touches(range);
    return all_visible;
  });
  return !all_visible;
}

}  // namespace triptych::technique
