#include "backends/opencl/particle_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "technique/particles/option_reason.hpp"

namespace triptych::opencl_backend {

std::optional<std::string> particle_defect(const Session& session, std::string_view technique,
                                           const measure::ParticleWork& work) {
  if (auto defect = technique::option_reason(technique, work.options,
                                             technique::SpriteRasterizer::in_tiles)) {
    return defect;
  }
  constexpr int most_pixels = 32768;  // an edge: pixel rectangles have 16 bits for a place
  if (work.scene.width > most_pixels || work.scene.height > most_pixels) {
    return fmt::format("the picture is {}x{}, this rasterizer reaches {}x{}", work.scene.width,
                       work.scene.height, most_pixels, most_pixels);
  }
  const auto most = checked([&] { return session.device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(); });
  const auto total = checked([&] { return session.device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>(); });
  const std::uint64_t count = work.scene.particles->count();
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(work.scene.width) * static_cast<std::uint64_t>(work.scene.height);
  const std::uint64_t largest = 16 * std::max(count, pixels);  // spheres; the picture
  if (largest > most) {
    return fmt::format(
        "{} particles and {} pixels take {} bytes, CL_DEVICE_MAX_MEM_ALLOC_SIZE is {}", count,
        pixels, largest, most);
  }
  // Sphere, the same in camera space, rectangle, colour, id; picture, id, depth, winner.
  const std::uint64_t all = (16 + 16 + 8 + 16 + 4) * count + 28 * pixels;
  if (all > total) {
    return fmt::format("{} bytes are needed, CL_DEVICE_GLOBAL_MEM_SIZE is {}", all, total);
  }
  return std::nullopt;
}

}  // namespace triptych::opencl_backend
