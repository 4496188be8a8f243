#include "technique/volume/raycast_buffers.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "technique/volume/bricks.hpp"
#include "technique/volume/extra_work.hpp"
#include "technique/volume/parts.hpp"
#include "technique/volume/quadrature_table.hpp"

namespace triptych::technique {
namespace {

constexpr std::uint64_t word = sizeof(std::uint32_t);

std::uint64_t drawn(const scene::VolumeScene& scene, const RaycastOptions& options) {
  return static_cast<std::uint64_t>(
      drawn_pixels(scene.width, scene.height, options.extra_work_stride));
}

}  // namespace

RaycastBuffers raycast_buffers(const scene::VolumeScene& scene, const RaycastOptions& options) {
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
  return {
      .image = 4 * word * drawn(scene, options),
      .counters = raycast_counter_stride * word * pixels,
      .bricks = brick_map_bytes(scene.grid->size, brick_layout(scene, options.skip, options.adapt)),
      .table = quadrature_table_bytes(scene.quadrature)};
}

std::uint64_t pauses_bytes(const scene::VolumeScene& scene, const RaycastOptions& options) {
  return pause_bytes * drawn(scene, options);
}

std::optional<std::string> buffer_reason(const RaycastBuffers& buffers, std::uint64_t most,
                                         std::string_view limit) {
  for (const auto& [name, bytes] : std::to_array<std::pair<std::string_view, std::uint64_t>>(
           {{"image", buffers.image},
            {"counters", buffers.counters},
            {"brick map", buffers.bricks},
            {"quadrature table", buffers.table},
            {"paused rays", buffers.pauses}})) {
    if (bytes <= most) continue;
    return fmt::format("the raycaster needs {} bytes for its {}, but {} is {}", bytes, name, limit,
                       most);
  }
  return std::nullopt;
}

}  // namespace triptych::technique
