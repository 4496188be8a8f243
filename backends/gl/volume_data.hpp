#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "backends/gl/objects.hpp"
#include "backends/gl/volume_parts.hpp"
#include "measure/contract/backend.hpp"
#include "scene/volume.hpp"

namespace triptych::gl_backend {

// How a texture stores a voxel format.
struct TexelFormat {
  GLenum internal = GL_R32F;
  GLenum type = GL_FLOAT;
};
[[nodiscard]] TexelFormat texel_format(scene::VoxelFormat format);

// Creates a 3D texture with one channel, clamped to the edge. `linear` selects linear filtering;
// otherwise the texture is not filtered.
[[nodiscard]] Texture volume_texture(const Api& gl, const scene::VoxelGrid& grid, bool linear);

[[nodiscard]] inline bool is_packed(const measure::VolumeWork& work) {
  return work.options.sampler == technique::Sampler::packed;
}

// constant_buffer() creates a buffer with the given bytes, which the host never writes again.
// device_buffer() creates a buffer of `size` bytes that the device writes.
[[nodiscard]] Buffer constant_buffer(const Api& gl, std::span<const std::byte> bytes);
[[nodiscard]] Buffer device_buffer(const Api& gl, std::size_t size);
// Creates a device_buffer() for 32-bit words, at least four of them.
[[nodiscard]] Buffer device_words(const Api& gl, std::size_t count);

// Fills the whole buffer with measure::poison_word.
void poison_buffer(const Api& gl, const Buffer& buffer);
// Fills the whole buffer with `word`.
void refill_buffer(const Api& gl, const Buffer& buffer, GLuint word);

// Fill writes the part of a buffer that begins at byte `begin`. fill_buffer() uploads the whole
// buffer through a small staging buffer.
using Fill = std::function<void(std::size_t begin, std::span<std::byte> out)>;
void fill_buffer(const Api& gl, const Buffer& buffer, std::size_t size, const Fill& fill);

// All data on the device that the shared raycasting shader reads.
class VolumeData {
 public:
  // If there are `parts` (technique::cut_into_parts), the voxels are uploaded only by move_part().
  VolumeData(const Api& gl, const measure::VolumeWork& work,
             const std::vector<technique::Part>& parts);

  [[nodiscard]] int parts() const { return parts_ ? parts_->count() : 0; }
  // Uploads the n-th part. The data must be bound.
  void move_part(const Api& gl, int n) const;

  // Binds the data to bindings 0…3, 6 and 7 of the shared source.
  void bind(const Api& gl) const;

 private:
  void make_texel_views(const Api& gl, const measure::VolumeWork& work,
                        const std::vector<technique::Part>& parts);

  Buffer bricks_;
  Buffer quadrature_;
  Buffer parameters_;
  std::optional<VolumeParts> parts_;
  Buffer pauses_;  // the states that rays keep from one part to the next
  // The voxels and the transfer function are textures. With the packed sampler, they are stored in
  // the buffers cells_ and table_, and the shader reads them, the bricks and the quadrature through
  // buffer textures.
  Buffer cells_;
  Buffer table_;
  struct BoundTexture {
    GLuint unit = 0;
    GLenum target = GL_TEXTURE_3D;
    Texture texture;
  };
  std::vector<BoundTexture> textures_;
};

}  // namespace triptych::gl_backend
