#pragma once
// Computes the counters of an OpenGL or Vulkan frame from the sums that the shared shaders write.

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "core/image.hpp"
#include "technique/catalogue.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::technique {

// The columns of the counter buffer. The values equal those of the constants TRI_COUNT_… in
// parameters.glsl.
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

// The shaders' buffer has this many rows of 32-bit sums.
inline constexpr std::size_t particle_counter_rows = 1024;
inline constexpr std::size_t particle_counter_columns = 8;
inline constexpr std::size_t particle_counter_bytes =
    particle_counter_rows * particle_counter_columns * sizeof(std::uint32_t);

// Returns the number of distinct particles that are visible in the image.
[[nodiscard]] std::uint64_t visible_ids(const core::Image& image);

struct CountedFrame {
  Method method = Method::sprites;
  // Without culling, the shaders do not count what is submitted, because the frame submits all
  // cells and particles.
  Culling culling = Culling::none;
  std::uint64_t cells = 0;
  std::uint64_t particles = 0;
};
// Computes Triptych's own counters, which have the same names on every API. Each technique reports
// only the counters that apply to it. The counts come from frames drawn with Purpose::counters.
//   cells, cells_culled   cells (groups of particles), and cells that were left out
//   particles_submitted   particles of the cells that were drawn
//   particles_culled      particles of the cells that were left out
//   sprites               particles whose sprite (for tiles: pixel rectangle) is not empty
//   vertices              corners of the non-empty sprites (0 for tiles)
//   fragments             pixel centres that the sprites cover, before any depth test
//   fragments_discarded   fragments whose ray hits no point of the sphere in front of the eye
//   fragments_kept        fragments that were not discarded
//   bin_entries           (tile, particle) pairs, for tiles and for the rasterizer in OpenCL
//   nodes_visited         for rays: inner nodes of the hierarchy whose children were tested
//   boxes_tested          for rays: tests of the boxes of nodes and of single spheres
//   intersections_tested  for rays: tests of a pixel's ray with a sphere
//   visible_ids           the number of different particles in the image, for all techniques
// `sums` contains all rows of the buffer.
[[nodiscard]] std::map<std::string, std::uint64_t> particle_counts(
    const CountedFrame& frame, std::span<const std::uint32_t> sums, const core::Image& image);

}  // namespace triptych::technique
