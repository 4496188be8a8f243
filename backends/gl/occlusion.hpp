#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "backends/gl/objects.hpp"
#include "backends/gl/particle_source.hpp"

namespace triptych::gl_backend {

// The data that the two passes of occlusion culling use (technique/particles/occlusion.glsl): the
// cells (ranges of neighbouring particles) that were visible in the previous frame, and the
// farthest depth in each block of pixels.
class Occlusion {
 public:
  Occlusion(const Api& gl, const measure::ParticleWork& work, std::size_t cells);

  // Must be called before the first draw of a frame. The cells that were visible in the previous
  // frame become the "before" set of occlusion.glsl.
  void start_frame(const Api& gl);
  // Must be called between the two draws of a frame. Computes the farthest depth in each block of
  // the image drawn so far.
  void find_farthest(const Api& gl, GLuint depth_texture) const;
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  std::array<GLuint, 2> blocks_;
  std::array<Buffer, 2> visible_;  // visible cells of the previous frame and of this frame
  Buffer farthest_;
  std::string source_;
  Program program_;
};

}  // namespace triptych::gl_backend
