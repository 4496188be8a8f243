#pragma once
// Finds the reasons why a device cannot draw a volume or particles with a technique.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "backends/vulkan/gpu.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::vulkan_backend {

// The optional device features that techniques need.
enum class Needs : std::uint8_t {
  nothing,
  drawing,
  geometry,
  tessellation,
  ray_query,
  ray_pipeline,
  mesh
};

// Returns the missing feature, if any.
[[nodiscard]] std::optional<std::string> feature_reason(const Gpu& gpu, Needs needs);
// Returns the limit that an image of this size exceeds. The limits are the framebuffer size, if the
// technique draws into a framebuffer, and the size of a storage buffer with `pixel_bytes` per
// pixel.
[[nodiscard]] std::optional<std::string> image_reason(const Gpu& gpu, int width, int height,
                                                      Needs needs, std::uint64_t pixel_bytes);
[[nodiscard]] std::optional<std::string> memory_reason(const Gpu& gpu, std::uint64_t needed);

[[nodiscard]] std::optional<std::string> volume_reason(const Gpu& gpu,
                                                       const measure::VolumeWork& work,
                                                       std::string_view technique, Needs needs);
[[nodiscard]] std::optional<std::string> particle_reason(const Gpu& gpu,
                                                         const measure::ParticleWork& work,
                                                         const std::string& technique, Needs needs);

}  // namespace triptych::vulkan_backend
