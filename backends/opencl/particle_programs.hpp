#pragma once
// The device code of the particle techniques. It is divided into three programs, so that a program
// is not compiled again for an option that it does not use.

#include <cstdint>
#include <string>

#include "backends/opencl/programs.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// How the pixels of a particle are found (TRI_SPRITE of particle_sprite.cl).
enum class Sprite : std::uint8_t {
  rectangle,  // none: the pixels around the silhouette
  screen_quad,
  ray_quad,
  polygon,
  adaptive_polygon,
  // Vertices that separate passes compute (particle_expand.cl):
  expanded_quad,   // a geometry stage's
  evaluated_quad,  // those of tessellation stages
  point
};
// The number of words that these passes store for each particle: the patch and its vertices, or a
// point.
[[nodiscard]] constexpr std::size_t stored_words(Sprite sprite) {
  if (sprite == Sprite::point) return 8;
  return sprite == Sprite::expanded_quad || sprite == Sprite::evaluated_quad ? 16 : 0;
}
[[nodiscard]] constexpr std::size_t patch_words(Sprite sprite) {
  return sprite == Sprite::evaluated_quad ? 12 : 0;
}

// The compile-time constants of particles.cl and the files that follow it. A build that neither
// counts nor injects a fault contains no code for that.
struct ParticleConstants {
  Sprite sprite = Sprite::rectangle;
  scene::ColourKind colour = scene::ColourKind::rgba8;
  bool transfer_at_pixel = true;
  bool ray_at_vertex = false;
  bool conservative_depth = false;
  bool traced = false;  // shading reads spheres in world space
  technique::ParticleFault fault = technique::ParticleFault::none;
  bool count = false;
};

// Constants of the timed build.
[[nodiscard]] ParticleConstants constants_of(const measure::ParticleWork& work, Sprite sprite);

// The edge of a tile in pixels, and of a coarse tile in tiles. A particle that covers more than
// `most_tiles` tiles is put into coarse tiles.
inline constexpr int tile_edge = 16;
inline constexpr int coarse_edge = 8;
inline constexpr int most_tiles = 16;
inline constexpr int scan_items = 64;  // work group of place_bins

struct ParticlePrograms {
  cl::Program cells;    // cull_cells, test_cells, list_cells, place_chunks, place_bins
  cl::Program sprites;  // count_bins, fill_bins, draw_tiles, those of particle_expand.cl
  cl::Program shading;  // colour_sprites, shade
};

[[nodiscard]] ParticlePrograms particle_programs(Programs& programs,
                                                 const ParticleConstants& constants);

struct RayPrograms {
  cl::Program rays;     // the kernels of particle_hierarchy.cl, and trace_tiles
  cl::Program shading;  // shade
};
[[nodiscard]] RayPrograms ray_programs(Programs& programs, const ParticleConstants& constants);
[[nodiscard]] std::string ray_hash(const ParticleConstants& constants);

// The content hash of the three programs, including their options.
[[nodiscard]] std::string particle_hash(const ParticleConstants& constants);

}  // namespace triptych::opencl_backend
