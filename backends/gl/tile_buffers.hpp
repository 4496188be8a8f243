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

// The data that the passes of tiles.glsl exchange.
class TileBuffers {
 public:
  // The number of entries that a round should not exceed; they take 64 MiB.
  static constexpr std::uint64_t wanted_entries = std::uint64_t{1} << 24U;
  enum class Cells : std::uint8_t { all, thinned };

  // The reason why an image of this size, or one of its cells, exceeds the device's limits; empty
  // if it does not.
  [[nodiscard]] static std::optional<std::string> unsupported(const Api& gl,
                                                              const scene::ParticleScene& scene);

  // If extra_work_stride is not 0, there are also thinned cells, and space for all particles twice.
  // Throws core::NotSupported if a buffer has more texels than the device can address.
  TileBuffers(const Api& gl, const scene::ParticleScene& scene,
              const technique::Arrangement& arrangement, const technique::TileRounds& rounds,
              const ParticleData& data, int extra_work_stride);

  // Binds bindings 6…20 of the shared sources.
  void bind(const Api& gl) const;
  void choose(const Api& gl, Cells cells) const;
  // Overwrites all data that a frame writes before it reads them.
  void poison(const Api& gl) const;
  // Empties tiles and lists, and also pixels if any round draws into them.
  void clear(const Api& gl) const;
  // Begins a round without large spheres, without entries, and without tiles that are drawn into.
  void start_round(const Api& gl) const;

  // The number of work groups: one for 64 tiles, and one for each tile that the round draws into.
  [[nodiscard]] GLuint groups_for_tiles() const;
  void dispatch_listed(const Api& gl) const;
  // The number of blocks of TRI_BLOCK × TRI_BLOCK tiles, which are drawn together.
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
  Buffer zeros_;         // the initial values of tiles and of a plane of depths
  Buffer no_particles_;  // the initial values of a plane of particle keys
};

}  // namespace triptych::gl_backend
