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

// The buffers through which the passes of tiles.glsl exchange data. A cell is a range of
// neighbouring particles. A round is a range of cells that are processed together. An entry is a
// pair of a tile and a large sphere that overlaps it.
class TileBuffers {
 public:
  // The number of entries that a round should not exceed. This many entries occupy 64 MiB.
  static constexpr std::uint64_t wanted_entries = std::uint64_t{1} << 24U;
  enum class Cells : std::uint8_t { all, thinned };

  // Returns the reason why an image of this size, or a single cell, exceeds the device's limits;
  // nullopt if neither does.
  [[nodiscard]] static std::optional<std::string> unsupported(const Api& gl,
                                                              const scene::ParticleScene& scene);

  // If extra_work_stride is not 0, also creates the thinned cells, and allocates space for twice as
  // many particles. Throws core::NotSupported if a buffer has more texels than the device can
  // address.
  TileBuffers(const Api& gl, const scene::ParticleScene& scene,
              const technique::Arrangement& arrangement, const technique::TileRounds& rounds,
              const ParticleData& data, int extra_work_stride);

  // Binds the buffers to the storage blocks 6…12, the texture units 13…19 and the image unit 0 of
  // the shared shaders.
  void bind(const Api& gl) const;
  void choose(const Api& gl, Cells cells) const;
  // Overwrites the data that every frame must write before it reads them, so that the image of a
  // frame is wrong if the frame fails to write them.
  void poison(const Api& gl) const;
  // Clears the tiles and all counts. Also clears the pixels if there may be small spheres, because
  // only small spheres are drawn into them.
  void clear(const Api& gl) const;
  // Begins a round with no large spheres, no entries, and no tiles to draw into.
  void start_round(const Api& gl) const;

  // groups_for_tiles() returns the number of work groups if each work group processes 64 tiles.
  // dispatch_listed() dispatches one work group per tile that the round draws into.
  [[nodiscard]] GLuint groups_for_tiles() const;
  void dispatch_listed(const Api& gl) const;
  // Returns the number of blocks of TRI_BLOCK × TRI_BLOCK tiles. The tiles of a block are drawn
  // together.
  [[nodiscard]] GLuint blocks() const;

 private:
  struct Texels {
    GLuint binding;
    Texture texture;
  };
  void clear_pixels(const Api& gl) const;
  void add_texel_view(const Api& gl, GLuint binding, GLuint buffer, std::size_t bytes,
                      GLenum format);
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
  Buffer zeros_;         // the initial contents of the tiles and of the depths in pixels_
  Buffer no_particles_;  // the initial contents of the particle keys in pixels_
};

}  // namespace triptych::gl_backend
