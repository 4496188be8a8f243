#pragma once
// The sizes of the buffers that a raycaster needs in addition to the volume. Backends compare these
// sizes with the limits of devices.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scene/volume_scene.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::technique {

// The size of each buffer in bytes.
struct RaycastBuffers {
  std::uint64_t pixels = 0;    // the number of pixels of the image
  std::uint64_t image = 0;     // includes the output of injected work (extra_work.hpp)
  std::uint64_t counters = 0;  // needed only for frames with counters
  std::uint64_t bricks = 0;    // one word for each brick; exists even if nothing is skipped
  std::uint64_t table = 0;     // table of the quadrature (quadrature_table.hpp)
  std::uint64_t pauses = 0;    // state of rays, if the volume is drawn in parts (parts.hpp)

  [[nodiscard]] std::uint64_t all() const { return image + counters + bricks + table + pauses; }
};
// Returns the sizes of all buffers except `pauses`.
[[nodiscard]] RaycastBuffers raycast_buffers(const scene::VolumeScene& scene,
                                             const RaycastOptions& options);

// Returns the number of bytes for the state of all rays between two passes.
[[nodiscard]] std::uint64_t pauses_bytes(const scene::VolumeScene& scene,
                                         const RaycastOptions& options);

// Returns a message that names the first buffer larger than `most` bytes, or nullopt if all buffers
// fit. `limit` is the API's name for that limit. If the buffer's size depends on the size of the
// image, the message names the largest square image whose buffers fit.
[[nodiscard]] std::optional<std::string> buffer_reason(const RaycastBuffers& buffers,
                                                       std::uint64_t most, std::string_view limit);

}  // namespace triptych::technique
