#pragma once
// The device code of the particle techniques. It is split into three programs, so that a program is
// not compiled again for an option that it does not use.

#include <cstdint>
#include <string>

#include "backends/opencl/programs.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// The way in which the pixels of a particle are found (TRI_SPRITE in particle_sprite.cl).
enum class Sprite : std::uint8_t {
  rectangle,  // no sprite: the pixels around the silhouette
  screen_quad,
  ray_quad,
  polygon,
  adaptive_polygon,
  // Sprites whose vertices are computed in separate passes (particle_expand.cl):
  expanded_quad,   // vertices from the counterpart of a geometry stage
  evaluated_quad,  // vertices from the counterparts of tessellation stages
  point
};
// Returns the number of words per particle that the separate vertex passes store: the patch and its
// vertices, or a point.
[[nodiscard]] constexpr std::size_t stored_words(Sprite sprite) {
  if (sprite == Sprite::point) return 8;
  return sprite == Sprite::expanded_quad || sprite == Sprite::evaluated_quad ? 16 : 0;
}
[[nodiscard]] constexpr std::size_t patch_words(Sprite sprite) {
  return sprite == Sprite::evaluated_quad ? 12 : 0;
}

// The compile-time constants of particles.cl and of the files that follow it. A build that does not
// count contains no code for counting, and a build without a fault no code for faults.
struct ParticleConstants {
  Sprite sprite = Sprite::rectangle;
  scene::ColourKind colour = scene::ColourKind::rgba8;
  bool transfer_at_pixel = true;
  bool ray_at_vertex = false;
  bool conservative_depth = false;
  bool traced = false;  // if rays are traced, shading reads the spheres in world space
  technique::ParticleFault fault = technique::ParticleFault::none;
  bool count = false;
};

// Returns the constants for programs that are used for timing, which count nothing.
[[nodiscard]] ParticleConstants constants_of(const measure::ParticleWork& work, Sprite sprite);

// The edge of a tile in pixels, and the edge of a coarse tile in tiles. A particle that covers more
// than `most_tiles` tiles is sorted into coarse tiles.
inline constexpr int tile_edge = 16;
inline constexpr int coarse_edge = 8;
inline constexpr int most_tiles = 16;
inline constexpr int scan_items = 64;  // work-group size of place_bins

struct ParticlePrograms {
  cl::Program cells;    // cull_cells, test_cells, list_cells, place_chunks, place_bins
  cl::Program sprites;  // count_bins, fill_bins, draw_tiles, and the kernels of particle_expand.cl
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

// Returns the content hash of the three programs, including their options.
[[nodiscard]] std::string particle_hash(const ParticleConstants& constants);

}  // namespace triptych::opencl_backend
