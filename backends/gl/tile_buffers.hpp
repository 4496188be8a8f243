#pragma once
#include <array>
#include <optional>
#include <string>

#include "backends/gl/objects.hpp"
#include "core/image.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// What the passes of tiles.glsl hand to each other.
class TileBuffers {
 public:
  // Entries that a round should not exceed: 64 MiB.
  static constexpr std::uint64_t wanted_entries = std::uint64_t{1} << 24U;
  enum class Cells : std::uint8_t { all, thinned };

  // Why a picture of this size, or a cell before it, is beyond the device; empty when it is not.
  [[nodiscard]] static std::optional<std::string> unsupported(const Api& gl,
                                                              const scene::ParticleScene& scene);

  // `entries`: the most that a round may have. With an extra_work_stride other than 0 there are
  // thinned cells too, and room for all particles twice.
  TileBuffers(const Api& gl, const scene::ParticleScene& scene,
              const technique::Arrangement& arrangement, std::uint64_t entries,
              int extra_work_stride);

  // Bindings 6…13 of the shared sources.
  void bind(const Api& gl) const;
  void choose(const Api& gl, Cells cells) const;
  // Empty pixels, tiles and lists.
  void clear(const Api& gl) const;
  // No large spheres and no entries.
  void start_round(const Api& gl) const;
  [[nodiscard]] core::Image read(const Api& gl, double near) const;

  // Work groups, along both axes: one per tile; 64 tiles each; 8×8 pixels each; and as many as go
  // through a list of unknown length together.
  [[nodiscard]] std::array<GLuint, 2> tiles() const { return tiles_; }
  [[nodiscard]] std::array<GLuint, 2> groups_for_tiles() const;
  [[nodiscard]] std::array<GLuint, 2> groups_of_pixels() const;
  [[nodiscard]] static std::array<GLuint, 2> spread_groups() { return {256, 1}; }

 private:
  [[nodiscard]] std::size_t pixel_bytes() const;
  [[nodiscard]] std::size_t tile_bytes() const;

  int width_;
  int height_;
  std::array<GLuint, 2> tiles_;
  Buffer cells_;
  Buffer thinned_;
  Buffer kept_spheres_;
  Buffer kept_;
  Buffer tile_states_;
  Buffer entries_;
  Buffer pixels_;
  Buffer cell_ends_;
  Buffer picture_;
  Buffer zeros_;         // what tiles, and a plane of depths, begin with
  Buffer no_particles_;  // and a plane of particle keys
};

}  // namespace triptych::gl_backend
