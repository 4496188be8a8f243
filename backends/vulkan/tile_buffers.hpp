#pragma once
// The buffers through which the passes of technique/particles/tiles.glsl exchange data. The frame
// is drawn in rounds, each of which processes a range of the particles. An entry is a pair of a
// tile and a large sphere that overlaps it.

#include <cstdint>
#include <vector>

#include "backends/vulkan/particle_data.hpp"
#include "technique/particles/tile_rounds.hpp"

namespace triptych::vulkan_backend {

// The bindings of the `tiles` shaders. Names that end in `texels_binding` are texel buffers,
// through which the shaders read the same data and the particles (tile_grid.glsl explains why). All
// other names are storage buffers (tiles.glsl), except large_pixels_binding, which is a storage
// image.
enum TileBinding : std::uint32_t {
  camera_spheres_binding = first_free_binding,
  kept_binding,
  tiles_binding,
  entries_binding,
  pixels_binding,
  cell_ends_binding,
  camera_texels_binding,
  tile_texels_binding,
  entry_texels_binding,
  pixel_texels_binding,
  sphere_texels_binding,
  colour_texels_binding,
  id_texels_binding,
  large_pixels_binding
};
[[nodiscard]] std::vector<vk::DescriptorSetLayoutBinding> tile_bindings();
[[nodiscard]] vk::raii::DescriptorPool tile_pool(const Gpu& gpu);

class TileBuffers {
 public:
  // Throws core::NotSupported if a buffer has more texels than the device can address.
  TileBuffers(const Gpu& gpu, const measure::ParticleWork& work, const ParticleData& data,
              const technique::TileRounds& rounds);

  void bind(vk::DescriptorSet set) const;
  // Overwrites the data that every frame must write before it reads them, so that the image of a
  // frame is wrong if the frame fails to write them.
  void poison() const;
  // Clears the tiles. Also clears the pixels if there may be small spheres, because only small
  // spheres are drawn into them.
  void clear(const vk::raii::CommandBuffer& commands) const;
  // Begins a round with no large spheres, no entries, and no tiles to draw into.
  void start_round(const vk::raii::CommandBuffer& commands) const;

  [[nodiscard]] std::uint32_t tiles() const noexcept { return columns_ * rows_; }
  // Returns the number of blocks of TRI_BLOCK × TRI_BLOCK tiles. The tiles of a block are drawn
  // together.
  [[nodiscard]] std::uint32_t blocks() const noexcept;
  // Dispatches one work group for each tile that the round draws into.
  void dispatch_listed(const vk::raii::CommandBuffer& commands) const;

 private:
  struct Texels {
    std::uint32_t binding;
    vk::raii::BufferView view;
  };
  void clear_pixels(const vk::raii::CommandBuffer& commands) const;

  const Gpu& gpu_;
  std::uint32_t columns_;
  std::uint32_t rows_;
  vk::DeviceSize plane_;  // bytes of one word per pixel; pixels_ consists of two such planes
  bool small_;
  Buffer camera_spheres_;
  Buffer kept_;
  Buffer tiles_;
  Buffer entries_;
  Buffer pixels_;
  Buffer cell_ends_;
  Image large_pixels_;
  std::vector<Texels> texels_;
};

}  // namespace triptych::vulkan_backend
