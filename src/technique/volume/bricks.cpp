#include "technique/volume/bricks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "technique/volume/brick_kinds.hpp"
#include "technique/volume/brick_reach.hpp"

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
        const Span xs = with_border(x, grid.size[0], layout);
        const Span ys = with_border(y, grid.size[1], layout);
        const Span zs = with_border(z, grid.size[2], layout);
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

std::vector<std::int32_t> brick_map(const scene::VolumeScene& scene, Skip skip, double adapt) {
  if (skip == Skip::none) return {1};
  const BrickRanges ranges = brick_ranges(*scene.grid, brick_layout(scene, skip, adapt));
  if (adapt > 0) return brick_kinds(ranges, scene, adapt);
  const auto visible = brick_visibility(ranges, scene.transfer_function);
  if (skip == Skip::distance) return brick_reach(ranges.counts, visible);
  return {visible.begin(), visible.end()};
}

}  // namespace triptych::technique
