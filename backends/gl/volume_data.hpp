#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "backends/gl/objects.hpp"
#include "measure/contract/backend.hpp"
#include "scene/volume.hpp"

namespace triptych::gl_backend {

// How a voxel format is kept in a texture.
struct TexelFormat {
  GLenum internal = GL_R32F;
  GLenum type = GL_FLOAT;
};
[[nodiscard]] TexelFormat texel_format(scene::VoxelFormat format);

// A 3D texture of one channel, clamped to the edge, filtered linearly or not at all.
[[nodiscard]] Texture volume_texture(const Api& gl, const scene::VoxelGrid& grid, bool linear);

[[nodiscard]] inline bool is_packed(const measure::VolumeWork& work) {
  return work.options.sampler == technique::Sampler::packed;
}

// A buffer with the given bytes, never written to again by the host; or of `size` bytes that the
// device writes.
[[nodiscard]] Buffer constant_buffer(const Api& gl, std::span<const std::byte> bytes);
[[nodiscard]] Buffer device_buffer(const Api& gl, std::size_t size);

// All that the shared raycasting source reads, on the device.
class VolumeData {
 public:
  VolumeData(const Api& gl, const measure::VolumeWork& work);

  // Makes the data what the shared source's bindings 0…3 and 6 stand for.
  void bind(const Api& gl) const;

 private:
  void see_texels(const Api& gl, const measure::VolumeWork& work);

  Buffer bricks_;
  Buffer quadrature_;
  Buffer parameters_;
  // Textures of voxels and transfer function; for sampler packed the buffers whose texels are seen
  // through textures, as are then bricks and quadrature.
  Buffer cells_;
  Buffer table_;
  struct Seen {
    GLuint unit = 0;
    GLenum target = GL_TEXTURE_3D;
    Texture texture;
  };
  std::vector<Seen> textures_;
};

}  // namespace triptych::gl_backend
