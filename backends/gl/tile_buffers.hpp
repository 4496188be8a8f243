#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "backends/gl/objects.hpp"
#include "backends/gl/particle_data.hpp"
#include "core/image.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/arrangement.hpp"
#include "technique/particles/tile_rounds.hpp"

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

  // With an extra_work_stride other than 0 there are thinned cells too, and room for all particles
  // twice. Throws core::NotSupported where a buffer has more texels than the device can see.
  TileBuffers(const Api& gl, const scene::ParticleScene& scene,
              const technique::Arrangement& arrangement, const technique::TileRounds& rounds,
              const ParticleData& data, int extra_work_stride);

  // Bindings 6…20 of the shared sources.
  void bind(const Api& gl) const;
  void choose(const Api& gl, Cells cells) const;
  // Overwrites what a frame writes anew before it reads it.
  void poison(const Api& gl) const;
  // Empty tiles and lists, and pixels unless no round ever draws into them.
  void clear(const Api& gl) const;
  // No large spheres, no entries and no tiles drawn into.
  void start_round(const Api& gl) const;

  // Work groups: 64 tiles each, and as many as there are tiles that the round draws into.
  [[nodiscard]] GLuint groups_for_tiles() const;
  void dispatch_listed(const Api& gl) const;
  // Of TRI_BLOCK × TRI_BLOCK tiles, which are drawn together.
  [[nodiscard]] GLuint blocks() const;

 private:
  struct Texels {
    GLuint binding;
    Texture texture;
  };
  void clear_pixels(const Api& gl) const;
  void see(const Api& gl, GLuint binding, GLuint buffer, std::size_t bytes, GLenum format);
  [[nodiscard]] std::size_t pixel_bytes() const;
  [[nodiscard]] std::size_t tile_bytes() const;

  int width_;
  int height_;
  std::array<GLuint, 2> tiles_;
  Buffer cells_;
  Buffer thinned_;
  bool small_;
  Buffer camera_spheres_;
  Buffer kept_;
  Buffer tile_states_;
  Buffer entries_;
  Buffer pixels_;
  Buffer cell_ends_;
  Texture large_pixels_;
  std::vector<Texels> texels_;
  Buffer zeros_;         // what tiles, and a plane of depths, begin with
  Buffer no_particles_;  // and a plane of particle keys
};

}  // namespace triptych::gl_backend
