#include "backends/opencl/particle_programs.hpp"

#include <fmt/format.h>

#include <bit>

#include "backends/opencl/programs.hpp"

namespace triptych::opencl_backend {

std::string ParticleConstants::options() const {
  // Never -cl-fast-relaxed-math or -cl-mad-enable: the same bits on every run and device.
  return fmt::format(
      "-cl-std=CL1.2 -DTRI_SPRITE={} -DTRI_COLOUR={} -DTRI_TRANSFER_AT_PIXEL={:d} "
      "-DTRI_RAY_AT_VERTEX={:d} -DTRI_CONSERVATIVE_DEPTH={:d} -DTRI_CULLING={} -DTRI_FAULT={} "
      "-DTRI_COUNT={:d} -DTRI_TILE={} -DTRI_TILE_SHIFT={} -DTRI_MOST_TILES={} "
      "-DTRI_SCAN_ITEMS={}",
      static_cast<int>(sprite), static_cast<int>(colour), transfer_at_pixel, ray_at_vertex,
      conservative_depth, static_cast<int>(culling), static_cast<int>(fault), count, tile_edge,
      std::countr_zero(static_cast<unsigned>(tile_edge)), most_tiles, scan_items);
}

std::string particle_source() {
  return program_source({"sphere_math.h", "particles.cl", "particle_cull.cl", "particle_colour.cl",
                         "particle_rectangle.cl", "particle_sprite.cl", "particle_bins.cl",
                         "particle_tiles.cl", "particle_shade.cl"});
}

ParticleConstants constants_of(const measure::ParticleWork& work, Sprite sprite) {
  const technique::ParticleOptions& options = work.options;
  const bool own = sprite == Sprite::rectangle;  // has neither vertices nor a depth unit
  return {.sprite = sprite,
          .colour = work.scene.particles->colour,
          .transfer_at_pixel = own || options.transfer == technique::ComputedAt::pixel,
          .ray_at_vertex = !own && options.ray == technique::ComputedAt::vertex,
          .conservative_depth = own || options.conservative_depth,
          .culling = options.culling,
          .fault = options.fault};
}

}  // namespace triptych::opencl_backend
