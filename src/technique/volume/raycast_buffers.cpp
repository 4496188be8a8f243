#include "technique/volume/raycast_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "technique/largest_image.hpp"
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

// Returns the width and height of the largest square image whose buffers have at most `most` bytes.
std::uint64_t largest_image(const RaycastBuffers& buffers, std::uint64_t most) {
  const std::uint64_t largest = std::max({buffers.image, buffers.counters, buffers.pauses});
  const double per_pixel = static_cast<double>(largest) / static_cast<double>(buffers.pixels);
  return largest_square(static_cast<std::uint64_t>(static_cast<double>(most) / per_pixel));
}

struct NamedBuffer {
  std::string_view name;
  std::uint64_t bytes;
  bool grows_with_image;
};

}  // namespace

RaycastBuffers raycast_buffers(const scene::VolumeScene& scene, const RaycastOptions& options) {
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
  return {
      .pixels = pixels,
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
  for (const auto& [name, bytes, grows_with_image] :
       std::to_array<NamedBuffer>({{"image", buffers.image, true},
                                   {"counters", buffers.counters, true},
                                   {"brick map", buffers.bricks, false},
                                   {"quadrature table", buffers.table, false},
                                   {"paused rays", buffers.pauses, true}})) {
    if (bytes <= most) continue;
    std::string reason = fmt::format("the raycaster needs {} bytes for its {}, but {} is {}", bytes,
                                     name, limit, most);
    if (grows_with_image) {
      reason += fmt::format("; the largest square image is {0}x{0}", largest_image(buffers, most));
    }
    return reason;
  }
  return std::nullopt;
}

}  // namespace triptych::technique
