#pragma once
// What a raycaster needs in buffers beside the volume itself, for backends to hold against limits.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scene/volume_scene.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::technique {

// Bytes of each buffer.
struct RaycastBuffers {
  std::uint64_t picture = 0;   // with what injected work leaves behind (extra_work.hpp)
  std::uint64_t counters = 0;  // of the frame that counts
  std::uint64_t bricks = 0;    // a word per brick; held though not read where nothing is skipped
  std::uint64_t table = 0;     // of its quadrature (quadrature_table.hpp)
  std::uint64_t pauses = 0;    // of rays, where the volume is drawn in parts (parts.hpp)

  [[nodiscard]] std::uint64_t all() const { return picture + counters + bricks + table + pauses; }
};
// Without pauses.
[[nodiscard]] RaycastBuffers raycast_buffers(const scene::VolumeScene& scene,
                                             const RaycastOptions& options);

// Of rays between two passes.
[[nodiscard]] std::uint64_t pauses_bytes(const scene::VolumeScene& scene,
                                         const RaycastOptions& options);

// The first buffer of more than `most` bytes, which the API knows as `limit`; empty where all fit.
[[nodiscard]] std::optional<std::string> buffer_reason(const RaycastBuffers& buffers,
                                                       std::uint64_t most, std::string_view limit);

}  // namespace triptych::technique
