#include "backends/opencl/particle_programs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <initializer_list>

#include "core/hash.hpp"

namespace triptych::opencl_backend {
namespace {

using technique::ParticleFault;

struct Part {
  std::string source;
  std::string options;
};

// Returns the options that all three programs share. The options -cl-fast-relaxed-math and
// -cl-mad-enable are never used, because results must be bit-identical in every run and on every
// device. `faults` lists the injected faults that this program implements. Other faults are
// injected elsewhere.
std::string common_options(const ParticleConstants& constants,
                           std::initializer_list<ParticleFault> faults) {
  const bool injected = std::ranges::find(faults, constants.fault) != faults.end();
  return fmt::format(
      "-cl-std=CL1.2 -DTRI_TILE={} -DTRI_TILE_SHIFT={} -DTRI_COUNT={:d} -DTRI_FAULT={}", tile_edge,
      std::countr_zero(static_cast<unsigned>(tile_edge)), constants.count,
      injected ? static_cast<int>(constants.fault) : 0);
}

Part cells_part(const ParticleConstants& constants) {
  return {program_source({"sphere_math.h", "particles.cl", "particle_rectangle.cl",
                          "particle_cull.cl", "particle_scan.cl"}),
          fmt::format("{} -DTRI_SCAN_ITEMS={}",
                      common_options(constants, {ParticleFault::missing_barrier}), scan_items)};
}

Part sprites_part(const ParticleConstants& constants) {
  const std::string common =
      common_options(constants, {ParticleFault::unresolved_ties, ParticleFault::reversed_depth,
                                 ParticleFault::wrong_sense, ParticleFault::lost_at_border});
  return {program_source({"sphere_math.h", "particles.cl", "particle_rectangle.cl",
                          "particle_sprite.cl", "particle_expand.cl", "particle_bins.cl",
                          "particle_tiles.cl"}),
          fmt::format("{} -DTRI_SPRITE={} -DTRI_RAY_AT_VERTEX={:d} -DTRI_CONSERVATIVE_DEPTH={:d} "
                      "-DTRI_MOST_TILES={}",
                      common, static_cast<int>(constants.sprite), constants.ray_at_vertex,
                      constants.conservative_depth, most_tiles)};
}

Part shading_part(ParticleConstants constants) {
  constants.count = false;  // this program counts nothing
  return {program_source({"sphere_math.h", "particles.cl", "particle_shade.cl"}),
          fmt::format("{} -DTRI_COLOUR={} -DTRI_TRANSFER_AT_PIXEL={:d} -DTRI_RAY_AT_VERTEX={:d}{}",
                      common_options(constants, {}), static_cast<int>(constants.colour),
                      constants.transfer_at_pixel, constants.ray_at_vertex,
                      constants.traced ? " -DTRI_TRACED=1" : "")};
}

Part rays_part(const ParticleConstants& constants) {
  const std::string common =
      common_options(constants, {ParticleFault::unresolved_ties, ParticleFault::reversed_depth,
                                 ParticleFault::wrong_sense, ParticleFault::small_box});
  return {program_source({"sphere_math.h", "box_math.h", "particles.cl", "particle_rectangle.cl",
                          "particle_sprite.cl", "particle_bins.cl", "particle_tiles.cl",
                          "particle_hierarchy.cl", "particle_rays.cl"}),
          fmt::format("{} -DTRI_SPRITE=0 -DTRI_RAY_AT_VERTEX=0 -DTRI_CONSERVATIVE_DEPTH=1 "
                      "-DTRI_MOST_TILES={}",
                      common, most_tiles)};
}

}  // namespace

ParticleConstants constants_of(const measure::ParticleWork& work, Sprite sprite) {
  const technique::ParticleOptions& options = work.options;
  const bool no_vertices = sprite == Sprite::rectangle;
  return {.sprite = sprite,
          .colour = work.scene.particles->colour,
          .transfer_at_pixel = no_vertices || options.transfer == technique::ComputedAt::pixel ||
                               work.scene.particles->colour != scene::ColourKind::intensity,
          .ray_at_vertex = options.ray == technique::ComputedAt::vertex,
          // Techniques without vertices do not imitate the depth test of a rasterizer, so their
          // tiles always reject hidden particles early.
          .conservative_depth = no_vertices || options.conservative_depth,
          .fault = options.fault};
}

ParticlePrograms particle_programs(Programs& programs, const ParticleConstants& constants) {
  const auto get = [&](const Part& part) { return programs.get(part.source, part.options); };
  return {.cells = get(cells_part(constants)),
          .sprites = get(sprites_part(constants)),
          .shading = get(shading_part(constants))};
}

RayPrograms ray_programs(Programs& programs, const ParticleConstants& constants) {
  const auto get = [&](const Part& part) { return programs.get(part.source, part.options); };
  return {.rays = get(rays_part(constants)), .shading = get(shading_part(constants))};
}

std::string ray_hash(const ParticleConstants& constants) {
  std::string all;
  for (const Part& part : {rays_part(constants), shading_part(constants)}) {
    all += Programs::hash(part.source, part.options);
  }
  return core::content_hash(all);
}

std::string particle_hash(const ParticleConstants& constants) {
  std::string all;
  for (const Part& part :
       {cells_part(constants), sprites_part(constants), shading_part(constants)}) {
    all += Programs::hash(part.source, part.options);
  }
  return core::content_hash(all);
}

}  // namespace triptych::opencl_backend
