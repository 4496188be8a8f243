#pragma once
// Device code of the particle techniques, in three programs, so that none is compiled again for an
// option that it does not know.

#include <cstdint>
#include <string>

#include "backends/opencl/programs.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// How a particle's pixels are found (TRI_SPRITE of particle_sprite.cl).
enum class Sprite : std::uint8_t {
  rectangle,  // none: the pixels around the silhouette
  screen_quad,
  ray_quad,
  polygon,
  adaptive_polygon,
  // Vertices from passes of their own (particle_expand.cl):
  expanded_quad,   // a geometry stage's
  evaluated_quad,  // those of tessellation stages
  point
};
// Words that such passes leave for each particle: vertices, or a point; and patches before them.
[[nodiscard]] constexpr std::size_t stored_words(Sprite sprite) {
  if (sprite == Sprite::point) return 8;
  return sprite == Sprite::expanded_quad || sprite == Sprite::evaluated_quad ? 16 : 0;
}
[[nodiscard]] constexpr std::size_t patch_words(Sprite sprite) {
  return sprite == Sprite::evaluated_quad ? 12 : 0;
}

// The compile-time constants of particles.cl and what follows it. A build that does not count or
// inject a fault holds no trace of it.
struct ParticleConstants {
  Sprite sprite = Sprite::rectangle;
  scene::ColourKind colour = scene::ColourKind::rgba8;
  bool transfer_at_pixel = true;
  bool ray_at_vertex = false;
  bool conservative_depth = false;
  bool traced = false;  // shading is given spheres in world space
  technique::ParticleFault fault = technique::ParticleFault::none;
  bool count = false;
};

// Constants of the timed build.
[[nodiscard]] ParticleConstants constants_of(const measure::ParticleWork& work, Sprite sprite);

// Edge of a tile in pixels, of a coarse one in tiles; a particle that reaches more tiles than
// `most_tiles` is put into coarse ones.
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
  cl::Program rays;     // those of particle_hierarchy.cl, and trace_tiles
  cl::Program shading;  // shade
};
[[nodiscard]] RayPrograms ray_programs(Programs& programs, const ParticleConstants& constants);
[[nodiscard]] std::string ray_hash(const ParticleConstants& constants);

// Content hash of the three, their options included.
[[nodiscard]] std::string particle_hash(const ParticleConstants& constants);

}  // namespace triptych::opencl_backend
