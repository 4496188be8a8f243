#include "backends/gl/particle_target.hpp"

#include <limits>

#include "backends/gl/framebuffer.hpp"

namespace triptych::gl_backend {

using technique::ParticleFault;

ParticleTarget::ParticleTarget(const Api& gl, int width, int height, ParticleFault fault)
    : width_(width),
      height_(height),
      fault_(fault),
      colour_(pixels(gl, GL_RGBA32F, width, height)),
      ids_(pixels(gl, GL_R32UI, width, height)),
      depth_(gl),
      framebuffer_(gl) {
  gl.BindTexture(GL_TEXTURE_2D, depth_.get());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width, height, 0, GL_DEPTH_COMPONENT,
                GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl.check("glTexImage2D");
  depth_.record_memory(gl.memory_ledger.image(sizeof(float) * static_cast<std::uint64_t>(width) *
                                              static_cast<std::uint64_t>(height)));
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.get());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_RENDERBUFFER, ids_.get());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.get(), 0);
  constexpr std::array<GLenum, 2> outputs{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl.DrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
  check_framebuffer(gl);
}

void ParticleTarget::bind(const Api& gl) const {
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  gl.Viewport(0, 0, width_, height_);
  gl.Enable(GL_DEPTH_TEST);
  // If two depths are equal, the sphere drawn first wins.
  GLenum passes = GL_GREATER;
  if (fault_ == ParticleFault::unresolved_ties) passes = GL_GEQUAL;
  if (fault_ == ParticleFault::reversed_depth) passes = GL_LESS;
  gl.DepthFunc(passes);
}

// Fills the depth buffer with a value that cannot remain in any pixel, because every frame first
// clears the depth to a different value.
void ParticleTarget::poison(const Api& gl) const {
  bind(gl);
  constexpr GLuint id = core::Image::no_particle - 1;
  constexpr float depth = 0.75F;
  poison_colour(gl);
  gl.ClearBufferuiv(GL_COLOR, 1, &id);
  gl.ClearBufferfv(GL_DEPTH, 0, &depth);
}

void ParticleTarget::clear(const Api& gl, const std::array<float, 4>& background) const {
  constexpr GLuint none = core::Image::no_particle;
  const float depth = fault_ == ParticleFault::reversed_depth ? 1.0F : 0.0F;
  gl.ClearBufferfv(GL_COLOR, 0, background.data());
  gl.ClearBufferuiv(GL_COLOR, 1, &none);
  gl.ClearBufferfv(GL_DEPTH, 0, &depth);
}

core::Image ParticleTarget::read(const Api& gl, double near) const {
  core::Image image(width_, height_);
  image.ids.resize(image.pixel_count());
  image.depth.resize(image.pixel_count());
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, image.rgba.data());
  gl.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl.ReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_INT, image.ids.data());
  gl.ReadPixels(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT, image.depth.data());
  gl.check("glReadPixels");
  to_distances(image, near);
  return image;
}

void to_distances(core::Image& image, double near) {
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    const double z = static_cast<double>(image.depth[i]);
    image.depth[i] = image.ids[i] == core::Image::no_particle || z == 0
                         ? std::numeric_limits<float>::infinity()
                         : static_cast<float>(near / z);
  }
}

}  // namespace triptych::gl_backend
