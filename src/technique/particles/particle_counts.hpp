#pragma once
// The results of a counting frame of GL or Vulkan, from the sums of the shared shaders.

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "core/image.hpp"
#include "technique/catalogue.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::technique {

// The values TRI_COUNT_… of parameters.glsl.
enum class ParticleCounter : std::uint8_t {
  sprites,
  vertices,
  fragments,
  discarded,
  bin_entries,
  submitted,
  cells_culled,
  // Techniques that trace rays have no sprites. Their counters use the same columns (traced.glsl).
  nodes_visited = 0,
  boxes_tested = 1,
  intersections_tested = 2
};

// The buffer of the shaders has this many rows of 32-bit sums.
inline constexpr std::size_t particle_counter_rows = 1024;
inline constexpr std::size_t particle_counter_columns = 8;
inline constexpr std::size_t particle_counter_bytes =
    particle_counter_rows * particle_counter_columns * sizeof(std::uint32_t);

// The number of different particles that the image shows.
[[nodiscard]] std::uint64_t visible_ids(const core::Image& picture);

struct CountedFrame {
  Method method = Method::sprites;
  // Without culling, all particles are submitted and the shaders do not count them.
  Culling culling = Culling::none;
  std::uint64_t cells = 0;
  std::uint64_t particles = 0;
};
// Our own counters, the same words on every API. A technique tells those that mean something for
// it; they come from Purpose::counters frames.
//   cells, cells_culled   cells of the arrangement, and those left out
//   particles_submitted   particles of the cells that were drawn
//   particles_culled      the rest
//   sprites               particles whose sprite (or, for tiles, pixel rectangle) is not empty
//   vertices              their corners (0 for tiles)
//   fragments             pixel centres that the sprites cover, before any depth test
//   fragments_discarded   of those, the ones whose ray misses the sphere or finds it behind
//   fragments_kept        the others
//   bin_entries           (tile, particle) pairs: tiles, and OpenCL's rasterizer
//   nodes_visited         inner nodes of the hierarchy whose children were tested: rays alone, as
//   boxes_tested          boxes of nodes and of single spheres, and
//   intersections_tested  (pixel, sphere) pairs
//   visible_ids           the different particles in the picture, which every one tells
// `sums`: all rows of the buffer.
[[nodiscard]] std::map<std::string, std::uint64_t> particle_counts(
    const CountedFrame& frame, std::span<const std::uint32_t> sums, const core::Image& picture);

}  // namespace triptych::technique
