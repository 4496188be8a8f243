#pragma once
// Options that a technique does not support on any device.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "technique/particles/particle_options.hpp"

namespace triptych::technique {

// The implementation that determines which pixels a sprite covers: the API's rasterizer, or kernels
// that use work groups to bin sprites into tiles. Some faults can be injected into only one of
// them.
enum class SpriteRasterizer : std::uint8_t { api, tiles };

// Returns why the technique (a name in the catalogue) does not support these options or the
// injected fault, or nullopt if it supports them. It does not consider the capabilities of a
// device, which the backends check.
[[nodiscard]] std::optional<std::string> option_reason(std::string_view technique,
                                                       const ParticleOptions& options,
                                                       SpriteRasterizer rasterizer);

}  // namespace triptych::technique
