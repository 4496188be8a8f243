#include "technique/volume/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "technique/catalogue.hpp"
#include "technique/volume/bricks.hpp"
#include "technique/volume/packed_cells.hpp"

namespace triptych::technique {
namespace {

int cells_of(const scene::VolumeScene& scene) {
  return scene.grid->size[2] + 1;
}

// Returns the number of additional cells on each side of a part, beyond the cells that contain its
// samples.
int overlap(const scene::VolumeScene& scene) {
  constexpr double widened_and_rounded = 2;
  double cells = widened_and_rounded + (scene.shading.enabled ? 1 : 0);
  // A step is given in units of the smallest spacing, and the spacing along z is not smaller than
  // that. A step therefore crosses at most ⌈step⌉ cells along z.
  if (scene.quadrature == scene::Quadrature::preintegrated) cells += std::ceil(scene.step_voxels);
  return static_cast<int>(std::min(cells, static_cast<double>(cells_of(scene))));
}

std::vector<Part> slabs(const scene::VolumeScene& scene, int thickness) {
  const int cells = cells_of(scene);
  const int beyond = overlap(scene);
  std::vector<Part> parts;
  for (int begin = 0; begin < cells; begin += thickness) {
    const int end = std::min(begin + thickness, cells);
    parts.push_back({begin, end, std::max(begin - beyond, 0), std::min(end + beyond, cells)});
  }
  return parts;
}

// Orders the parts: first the part that contains the eye or is nearest to it, then the parts on one
// side of it and the parts on the other side, each from near to far.
std::vector<Part> front_to_back(std::vector<Part> parts, const scene::VolumeScene& scene) {
  const double eye = scene.camera.eye.z / scene.grid->spacing[2] + 0.5;
  const auto before = std::ranges::find_if(
      parts, [&](const Part& part) { return eye < static_cast<double>(part.end); });
  auto nearest = before == parts.end() ? parts.end() - 1 : before;
  std::reverse(parts.begin(), nearest);
  std::rotate(parts.begin(), nearest, nearest + 1);
  Part& first = parts.front();
  first.begin = std::max(first.begin - 1, 0);
  first.end = std::min(first.end + 1, cells_of(scene));
  return parts;
}

std::optional<std::string> whole_only_reason(std::string_view technique,
                                             const RaycastOptions& options) {
  if (!technique::technique(technique).parts) {
    return fmt::format("{} cannot draw a volume in parts", technique);
  }
  if (options.sampler == Sampler::hardware) {
    return "drawing a volume in parts requires sampler=manual or sampler=packed, because a "
           "hardware sampler would round differently in each part";
  }
  return std::nullopt;
}

bool is_read(const Part& part, const scene::VolumeScene& scene, const RaycastOptions& options,
             std::span<const std::int32_t> map) {
  // Without the leaps of Skip::distance, a ray that steps from brick to brick may take one last
  // sample beyond its exit from a visible brick, so any part may be read.
  if (options.skip != Skip::distance) return true;
  const BrickLayout layout = brick_layout(scene, options.skip, options.adapt);
  const auto counts = brick_counts(scene.grid->size, layout);
  const auto layer = static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]);
  const int first = std::clamp((part.first_stored - 1) / layout.edge, 0, counts[2] - 1);
  const int last = std::clamp(part.end_stored / layout.edge, 0, counts[2] - 1);
  const auto near = map.subspan(layer * static_cast<std::size_t>(first),
                                layer * static_cast<std::size_t>(last - first + 1));
  return std::ranges::any_of(near, [](std::int32_t brick) { return brick > 0; });
}

}  // namespace

std::uint64_t Layers::largest_part_bytes(std::span<const Part> parts) const {
  return parts.empty() ? whole : bytes_of(most_stored_cells(parts));
}

Layers slice_layers(const std::array<int, 3>& size, scene::VoxelFormat format) {
  const std::uint64_t slice = static_cast<std::uint64_t>(size[0]) *
                              static_cast<std::uint64_t>(size[1]) * scene::bytes_of(format);
  return {.bytes = slice, .more = 1, .whole = slice * static_cast<std::uint64_t>(size[2])};
}

Layers packed_layers(const std::array<int, 3>& size, scene::VoxelFormat format) {
  const std::uint64_t layer =
      packed_bytes({size[0], size[1], 2}, format) - packed_bytes({size[0], size[1], 1}, format);
  const std::uint64_t whole = packed_bytes(size, format);
  return {.bytes = layer, .more = static_cast<int>(whole / layer) - size[2] - 1, .whole = whole};
}

Layers layers_of(const scene::VolumeScene& scene, const RaycastOptions& options) {
  const scene::VoxelGrid& grid = *scene.grid;
  return options.sampler == Sampler::packed ? packed_layers(grid.size, grid.format)
                                            : slice_layers(grid.size, grid.format);
}

MemoryLimit within_budget(MemoryLimit limit, const RaycastOptions& options) {
  if (options.budget == 0 || options.budget >= limit.bytes) return limit;
  return {options.budget, "the budget"};
}

Cut cut_into_parts(std::string_view technique, const scene::VolumeScene& scene,
                   const RaycastOptions& options, const Layers& layers, const MemoryLimit& limit) {
  const int cells = cells_of(scene);
  if (layers.whole <= limit.bytes) return {};
  const std::string too_large =
      fmt::format("the volume needs {} bytes, but {} is {}", layers.whole, limit.name, limit.bytes);
  if (const auto reason = whole_only_reason(technique, options)) {
    return {.parts = {}, .reason = too_large + "; " + *reason};
  }
  const int thinnest = 2 * overlap(scene) + 1;
  if (layers.bytes_of(thinnest) > limit.bytes) {
    return {.parts = {},
            .reason = fmt::format("{}; even its thinnest part needs {} bytes", too_large,
                                  layers.bytes_of(thinnest))};
  }
  const int most_stored_cells = static_cast<int>(limit.bytes / layers.bytes) - layers.more;
  const int most = most_stored_cells - (thinnest - 1);
  const int count = (cells + most - 1) / most;
  return {.parts = front_to_back(slabs(scene, (cells + count - 1) / count), scene), .reason = {}};
}

int most_stored_cells(std::span<const Part> parts) {
  int most = 0;
  for (const Part& part : parts) most = std::max(most, part.stored_cells());
  return most;
}

Slices slices_of(const Part& part, const scene::VoxelGrid& grid) {
  const std::size_t slice = slice_layers(grid.size, grid.format).bytes;
  const int first = std::max(part.first_stored - 1, 0);
  const int count = std::min(part.end_stored, grid.size[2]) - first;
  return {std::span(grid.data).subspan(slice * static_cast<std::size_t>(first),
                                       slice * static_cast<std::size_t>(count)),
          count};
}

std::vector<PartPass> part_passes(std::span<const Part> parts, const scene::VolumeScene& scene,
                                  const RaycastOptions& options,
                                  std::span<const std::int32_t> map) {
  std::vector<PartPass> passes;
  for (const Part& part : parts) {
    const auto number = static_cast<std::int32_t>(passes.size());
    passes.push_back(
        {.part = part,
         .parameters = {part.begin, part.end, part.first_stored, part.stored_cells(), number, {}},
         .read = is_read(part, scene, options, map)});
  }
  return passes;
}

std::uint64_t moved_bytes(std::span<const PartPass> passes, const Layers& layers) {
  std::uint64_t bytes = 0;
  for (const auto& [part, parameters, read] : passes) {
    if (read) bytes += layers.bytes_of(part.stored_cells());
  }
  return bytes;
}

}  // namespace triptych::technique
