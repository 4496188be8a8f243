#pragma once
#include <array>

#include "backends/gl/objects.hpp"
#include "core/image.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::gl_backend {

// The render target for particles: colour, ids and reversed depth.
class ParticleTarget {
 public:
  ParticleTarget(const Api& gl, int width, int height, technique::ParticleFault fault);

  // Binds this target, and sets its depth test.
  void bind(const Api& gl) const;
  // Overwrites every attachment; colour becomes NaN.
  void poison(const Api& gl) const;
  // Clears colour to the background, ids to "no particle", and depth to a value against which every
  // particle passes the depth test.
  void clear(const Api& gl, const std::array<float, 4>& background) const;
  // `near` is the scale of the depth buffer, which contains near/Z for a surface at the distance Z
  // along the view axis.
  [[nodiscard]] core::Image read(const Api& gl, double near) const;
  [[nodiscard]] GLuint depth_texture() const { return depth_.get(); }

 private:
  int width_;
  int height_;
  technique::ParticleFault fault_;
  Renderbuffer colour_;
  Renderbuffer ids_;
  Texture depth_;
  Framebuffer framebuffer_;
};

// Converts each depth near/Z to the distance Z along the view axis, or to +infinity if the pixel
// shows no particle.
void to_distances(core::Image& image, double near);

}  // namespace triptych::gl_backend
