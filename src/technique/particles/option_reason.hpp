#pragma once
// Which options a technique cannot be drawn with, whatever the device.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "technique/particles/particle_options.hpp"

namespace triptych::technique {

// Who finds the pixels of a sprite: the API's own rasterizer, or kernels that bin sprites into
// tiles by work groups, with what can go wrong there.
enum class SpriteRasterizer : std::uint8_t { of_the_api, in_tiles };

// Why the technique (a name of the catalogue) has no part that these options ask for, or ask to
// break; empty where it has. What a device lacks is for the backends to say.
[[nodiscard]] std::optional<std::string> option_reason(std::string_view technique,
                                                       const ParticleOptions& options,
                                                       SpriteRasterizer rasterizer);

}  // namespace triptych::technique
