#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "backends/gl/objects.hpp"
#include "backends/gl/particle_source.hpp"

namespace triptych::gl_backend {

// What the two passes of occlusion culling keep (technique/particles/occlusion.glsl): which cells
// the last frame showed, and the farthest depth in each block of pixels.
class Occlusion {
 public:
  Occlusion(const Api& gl, const measure::ParticleWork& work, std::size_t cells);

  // Before a frame's first draw: what this frame shows becomes what the last one showed.
  void start_frame(const Api& gl);
  // Between the two draws: the farthest depths of the picture so far.
  void find_farthest(const Api& gl, GLuint depth_texture) const;
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  std::array<GLuint, 2> blocks_;
  std::array<Buffer, 2> visible_;  // before, now
  Buffer farthest_;
  std::string source_;
  Program program_;
};

}  // namespace triptych::gl_backend
