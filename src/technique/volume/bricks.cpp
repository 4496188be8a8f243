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

// Voxels of brick b along an axis of n voxels, with the border.
Span with_border(int b, int n, const BrickLayout& layout) {
  return {std::max(0, b * layout.edge - layout.border),
          std::min(n, (b + 1) * layout.edge + layout.border + (layout.of_cells ? 1 : 0))};
}

struct Range {
  float minimum;
  float maximum;
};

// Of the normalised values that the brick holds with its border.
Range range_of(const scene::VoxelGrid& grid, const BrickLayout& layout, int x, int y, int z) {
  const auto nx = static_cast<std::size_t>(grid.size[0]);
  const auto ny = static_cast<std::size_t>(grid.size[1]);
  double lo = std::numeric_limits<double>::infinity();
  double hi = -lo;
  const Span xs = with_border(x, grid.size[0], layout);
  const Span ys = with_border(y, grid.size[1], layout);
  const Span zs = with_border(z, grid.size[2], layout);
  for (int k = zs.begin; k < zs.end; ++k) {
    for (int j = ys.begin; j < ys.end; ++j) {
      const std::size_t row = nx * (static_cast<std::size_t>(j) + ny * static_cast<std::size_t>(k));
      for (int i = xs.begin; i < xs.end; ++i) {
        const double value = grid.normalised(row + static_cast<std::size_t>(i));
        lo = std::min(lo, value);
        hi = std::max(hi, value);
      }
    }
  }
  return {static_cast<float>(lo), static_cast<float>(hi)};
}

// Calls visit(range) for every brick, x fastest, until it returns false.
template <typename Visit>
void visit_bricks(const scene::VoxelGrid& grid, const BrickLayout& layout, Visit visit) {
  const auto [bx, by, bz] = brick_counts(grid.size, layout);
  for (int z = 0; z < bz; ++z) {
    for (int y = 0; y < by; ++y) {
      for (int x = 0; x < bx; ++x) {
        if (!visit(range_of(grid, layout, x, y, z))) return;
      }
    }
  }
}

// Which ranges of values a transfer function gives any opacity to: O(1) each by a prefix sum.
class OpaqueRanges {
 public:
  explicit OpaqueRanges(const scene::TransferFunction& function) {
    for (std::size_t k = 0; k < entries; ++k) {
      opaque_before_[k + 1] = opaque_before_[k] + (function.entries[k][3] > 0 ? 1 : 0);
    }
  }

  // The range is widened by one table entry on each side.
  [[nodiscard]] bool touches(const Range& range) const {
    const std::size_t first = entry(range.minimum, -1);
    const std::size_t last = entry(range.maximum, 2);
    return opaque_before_[last + 1] > opaque_before_[first];
  }

 private:
  static constexpr int entries = 256;

  // So many entries beyond the one whose centre lies below the value.
  [[nodiscard]] static std::size_t entry(float value, int beyond) {
    const int below = static_cast<int>(std::floor(static_cast<double>(value) * entries - 0.5));
    return static_cast<std::size_t>(std::clamp(below + beyond, 0, entries - 1));
  }

  std::array<int, entries + 1> opaque_before_{};  // [k]: how many of the entries before k
};

}  // namespace

BrickLayout brick_layout(const scene::VolumeScene& scene, Skip skip, double adapt) {
  BrickLayout layout;
  if (skip == Skip::distance) layout = {.edge = 2, .border = 0, .of_cells = true};
  if (adapt > 0 && scene.shading.enabled) layout.border += 1;
  if (scene.quadrature == scene::Quadrature::preintegrated) {
    const double half = scene.step_voxels / 2;
    const double farther = layout.of_cells ? std::ceil(half) : std::floor(half + 0.75);
    // No border need be wider than the volume.
    const int longest = std::max({scene.grid->size[0], scene.grid->size[1], scene.grid->size[2]});
    layout.border += static_cast<int>(std::min(farther, static_cast<double>(longest)));
  }
  return layout;
}

std::array<int, 3> brick_counts(const std::array<int, 3>& size, const BrickLayout& layout) {
  std::array<int, 3> counts{};
  std::ranges::transform(size, counts.begin(), [&](int n) {
    const int length = layout.of_cells ? std::max(n - 1, 1) : n;
    return (length + layout.edge - 1) / layout.edge;
  });
  return counts;
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
