#include "backends/gl/occlusion.hpp"

#include <span>
#include <utility>
#include <vector>

#include "backends/gl/volume_data.hpp"

namespace triptych::gl_backend {
namespace {

// The bindings of technique/particles/occlusion.glsl, and the texture unit of depth_image, which
// this file declares below.
constexpr GLuint binding_before = 8;
constexpr GLuint binding_now = 9;
constexpr GLuint binding_farthest = 10;
constexpr GLuint unit_depth = 3;
constexpr int cull_block_edge = 16;

GLuint blocks(int pixels) {
  return static_cast<GLuint>((pixels + cull_block_edge - 1) / cull_block_edge);
}

}  // namespace

Occlusion::Occlusion(const Api& gl, const measure::ParticleWork& work, std::size_t cells)
    : blocks_{blocks(work.scene.width), blocks(work.scene.height)},
      farthest_(device_buffer(gl, sizeof(GLuint) * blocks_[0] * blocks_[1])) {
  // Before the first frame, all cells (ranges of neighbouring particles) count as visible.
  const std::vector<GLuint> ones(cells + 1, 1U);
  for (Buffer& each : visible_) each = constant_buffer(gl, std::as_bytes(std::span(ones)));
  const std::vector<Stage> stages =
      particle_stages(gl, particle_constants(work),
                      {{GL_COMPUTE_SHADER,
                        {"farthest.comp.glsl"},
                        "layout(binding = 3) uniform sampler2D depth_image;\n"
                        "#define TRI_DEPTH(pixel) texelFetch(depth_image, pixel, 0).r\n"}});
  source_ = stages.front().source;
  program_ = link(gl, stages);
}

void Occlusion::start_frame(const Api& gl) {
  std::swap(visible_[0], visible_[1]);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_before, visible_[0].get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_now, visible_[1].get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_farthest, farthest_.get());
}

void Occlusion::find_farthest(const Api& gl, GLuint depth_texture) const {
  gl.MemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  gl.ActiveTexture(GL_TEXTURE0 + unit_depth);
  gl.BindTexture(GL_TEXTURE_2D, depth_texture);
  gl.UseProgram(program_.get());
  gl.DispatchCompute(blocks_[0], blocks_[1], 1);
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace triptych::gl_backend
