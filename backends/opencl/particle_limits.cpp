#include "backends/opencl/particle_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "backends/opencl/particle_programs.hpp"
#include "technique/particles/option_reason.hpp"

namespace triptych::opencl_backend {

BinTable bin_table(int width, int height, std::size_t particles) {
  constexpr std::size_t per_chunk = 512;
  constexpr std::size_t fewest = 16;
  constexpr std::size_t most = 512;
  constexpr std::size_t most_words = std::size_t{1} << 24;
  const auto parts = [](std::size_t n, std::size_t edge) { return (n + edge - 1) / edge; };
  const std::size_t columns = parts(static_cast<std::size_t>(width), tile_edge);
  const std::size_t rows = parts(static_cast<std::size_t>(height), tile_edge);
  const std::size_t bins = columns * rows + parts(columns, coarse_edge) * parts(rows, coarse_edge);
  const std::size_t chunks = std::min(std::min(particles / per_chunk, most), most_words / bins);
  return {.bins = bins, .chunks = std::max(chunks, fewest)};
}

std::optional<std::string> particles_unsupported(const Session& session, std::string_view technique,
                                                 const measure::ParticleWork& work) {
  if (auto defect =
          technique::option_reason(technique, work.options, technique::SpriteRasterizer::tiles)) {
    return defect;
  }
  // The largest width and height of an image, because pixel rectangles store each coordinate in 16
  // bits.
  constexpr int most_pixels = 32768;
  if (work.scene.width > most_pixels || work.scene.height > most_pixels) {
    return fmt::format("the image has {}x{} pixels, but this rasterizer supports at most {}x{}",
                       work.scene.width, work.scene.height, most_pixels, most_pixels);
  }
  const auto items =
      checked([&] { return session.device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>(); });
  if (items < scan_items) {
    return fmt::format(
        "binning sprites requires work-groups of {} work items, but CL_DEVICE_MAX_WORK_GROUP_SIZE "
        "is {}",
        scan_items, items);
  }
  const auto most = checked([&] { return session.device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(); });
  const auto total = checked([&] { return session.device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>(); });
  const std::uint64_t count = work.scene.particles->count();
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(work.scene.width) * static_cast<std::uint64_t>(work.scene.height);
  const std::uint64_t table =
      sizeof(cl_uint) * bin_table(work.scene.width, work.scene.height, count).words();
  const std::uint64_t largest = std::max(16 * std::max(count, pixels), table);
  if (largest > most) {
    return fmt::format(
        "{} particles and {} pixels need a buffer of {} bytes, but CL_DEVICE_MAX_MEM_ALLOC_SIZE "
        "is {}",
        count, pixels, largest, most);
  }
  // quad_tess stores more data per particle in its passes than any other technique: 28 words. Every
  // technique also stores for each particle the sphere in world and in camera space, the rectangle,
  // the colour and the id. For each pixel, it stores the image, the id and, for each pass, the
  // depth and the index of the visible particle. Each pass also has a BinTable.
  const std::uint64_t passes = work.options.extra_work_stride > 0 ? 2 : 1;
  const std::uint64_t all =
      (16 + 16 + 8 + 16 + 4 + 4 * 28) * count + 20 * pixels + passes * (8 * pixels + table);
  if (all > total) {
    return fmt::format("needs {} bytes of device memory, but CL_DEVICE_GLOBAL_MEM_SIZE is {}", all,
                       total);
  }
  return std::nullopt;
}

}  // namespace triptych::opencl_backend
