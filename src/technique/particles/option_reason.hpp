#pragma once
// Options that a technique does not support on any device.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "technique/particles/particle_options.hpp"

namespace triptych::technique {

// Determines which pixels a sprite covers: either the rasterizer of the API, or kernels that bin
// sprites into tiles with work groups. The possible faults depend on this.
enum class SpriteRasterizer : std::uint8_t { of_the_api, in_tiles };

// The reason why the technique (a name in the catalogue) lacks what these options request or inject
// a fault into; empty if it lacks nothing. The capabilities of a device are checked by the
// backends.
[[nodiscard]] std::optional<std::string> option_reason(std::string_view technique,
                                                       const ParticleOptions& options,
                                                       SpriteRasterizer rasterizer);

}  // namespace triptych::technique
