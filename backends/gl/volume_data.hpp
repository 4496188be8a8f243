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

// The storage of a voxel format in a texture.
struct TexelFormat {
  GLenum internal = GL_R32F;
  GLenum type = GL_FLOAT;
};
[[nodiscard]] TexelFormat texel_format(scene::VoxelFormat format);

// A 3D texture with one channel, clamped to the edge, filtered linearly or not at all.
[[nodiscard]] Texture volume_texture(const Api& gl, const scene::VoxelGrid& grid, bool linear);

[[nodiscard]] inline bool is_packed(const measure::VolumeWork& work) {
  return work.options.sampler == technique::Sampler::packed;
}

// A buffer with the given bytes, which the host never writes again; or a buffer of `size` bytes
// that the device writes.
[[nodiscard]] Buffer constant_buffer(const Api& gl, std::span<const std::byte> bytes);
[[nodiscard]] Buffer device_buffer(const Api& gl, std::size_t size);
// The same for 32-bit words; it has at least four.
[[nodiscard]] Buffer device_words(const Api& gl, std::size_t count);

// Fills the whole buffer with measure::poison_word.
void poison_buffer(const Api& gl, const Buffer& buffer);
// The same for words of another type.
void refill_buffer(const Api& gl, const Buffer& buffer, GLuint word);

// Writes the part of a buffer that begins at byte `begin`.
using Fill = std::function<void(std::size_t begin, std::span<std::byte> out)>;
void fill_buffer(const Api& gl, const Buffer& buffer, std::size_t size, const Fill& fill);

// Everything on the device that the shared raycasting source reads.
class VolumeData {
 public:
  // With `parts` (technique::cut_into_parts), there are no voxels until they are moved.
  VolumeData(const Api& gl, const measure::VolumeWork& work,
             const std::vector<technique::Part>& parts);

  [[nodiscard]] int parts() const { return parts_ ? parts_->count() : 0; }
  // Moves the n-th part. The data must be bound.
  void move_part(const Api& gl, int n) const;

  // Binds the data to bindings 0…3, 6 and 7 of the shared source.
  void bind(const Api& gl) const;

 private:
  void see_texels(const Api& gl, const measure::VolumeWork& work,
                  const std::vector<technique::Part>& parts);

  Buffer bricks_;
  Buffer quadrature_;
  Buffer parameters_;
  std::optional<VolumeParts> parts_;
  Buffer pauses_;  // the states of rays between two parts
  // Textures of the voxels and the transfer function. For sampler packed, these are buffers that
  // the shader reads as texture buffers, and the same holds for the bricks and the quadrature.
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
