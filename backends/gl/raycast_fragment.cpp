// Traces one ray per fragment of a triangle that covers a floating-point render target.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "backends/gl/framebuffer.hpp"
#include "backends/gl/pass.hpp"
#include "backends/gl/techniques.hpp"
#include "backends/gl/volume_prepared.hpp"
#include "technique/volume/extra_work.hpp"

namespace triptych::gl_backend {
namespace {

// The RGBA32F render target.
class Target {
 public:
  Target(const Api& gl, int width, int height)
      : pixels_(pixels(gl, GL_RGBA32F, width, height)), framebuffer_(gl) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                               pixels_.get());
    check_framebuffer(gl);
  }
  void bind(const Api& gl) const { gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get()); }

 private:
  Renderbuffer pixels_;
  Framebuffer framebuffer_;
};

class FragmentPass final : public Pass {
 public:
  FragmentPass(const Api& gl, int width, int height, int extra_work_stride)
      : width_(width),
        height_(height),
        extra_tiles_(technique::extra_tiles(width, height, extra_work_stride)),
        no_vertices_(gl),
        target_(gl, width, height) {}

  [[nodiscard]] std::vector<Stage> stages(const Api& gl,
                                          const Constants& constants) const override {
    return {plain_stage(gl, GL_VERTEX_SHADER, "full_screen.vert"),
            volume_stage(gl, GL_FRAGMENT_SHADER, constants, "raycast.frag")};
  }

  [[nodiscard]] std::span<const Statistic> statistics() const override {
    static constexpr std::array<Statistic, 6> wanted{{
        {GL_VERTICES_SUBMITTED_ARB, "input_assembly_vertices"},
        {GL_PRIMITIVES_SUBMITTED_ARB, "input_assembly_primitives"},
        {GL_VERTEX_SHADER_INVOCATIONS_ARB, "vertex_invocations"},
        {GL_CLIPPING_INPUT_PRIMITIVES_ARB, "clipping_invocations"},
        {GL_CLIPPING_OUTPUT_PRIMITIVES_ARB, "clipping_primitives"},
        {GL_FRAGMENT_SHADER_INVOCATIONS_ARB, "fragment_invocations"},
    }};
    return wanted;
  }

  void poison(const Api& gl) override {
    target_.bind(gl);
    poison_colour(gl);
  }

  void bind(const Api& gl) override {
    gl.BindVertexArray(no_vertices_.get());
    target_.bind(gl);
    gl.Viewport(0, 0, width_, height_);
  }

  // The extra work is drawn after the image, because a driver may skip a draw whose pixels a later
  // draw overwrites.
  void submit(const Api& gl, measure::Purpose purpose) override {
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    if (extra_tiles_.empty() || purpose == measure::Purpose::counters) return;
    gl.Enable(GL_SCISSOR_TEST);
    for (const technique::ExtraTile& tile : extra_tiles_) {
      gl.Scissor(tile.x, tile.y, tile.width, tile.height);
      gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl.Disable(GL_SCISSOR_TEST);
  }

  [[nodiscard]] core::Image read(const Api& gl) const override {
    core::Image image(width_, height_);
    target_.bind(gl);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, image.rgba.data());
    gl.check("glReadPixels");
    return image;
  }

 private:
  int width_;
  int height_;
  std::vector<technique::ExtraTile> extra_tiles_;
  VertexArray no_vertices_;  // the core profile draws nothing unless a vertex array object is bound
  Target target_;
};

std::optional<std::string> raycast_fragment_unsupported(const Api& gl,
                                                        const measure::VolumeWork& work) {
  const std::int64_t edge = gl.limit(GL_MAX_RENDERBUFFER_SIZE);
  if (std::max(work.scene.width, work.scene.height) > edge) {
    return fmt::format("the image has {}x{} pixels, but GL_MAX_RENDERBUFFER_SIZE is {}",
                       work.scene.width, work.scene.height, edge);
  }
  constexpr std::int64_t needed = 3;  // bricks, counters, quadrature
  const std::int64_t blocks = gl.limit(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS);
  if (blocks < needed) {
    return fmt::format("needs {} storage blocks, but GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS is {}",
                       needed, blocks);
  }
  return std::nullopt;
}

std::unique_ptr<measure::Prepared> prepare_raycast_fragment(Context& context, Stamps stamps,
                                                            const measure::VolumeWork& work) {
  return prepare_volume(
      context, stamps, work, constants_of(work),
      std::make_unique<FragmentPass>(context.gl(), work.scene.width, work.scene.height,
                                     work.options.extra_work_stride));
}

}  // namespace

VolumeTechnique raycast_fragment() {
  return {&raycast_fragment_unsupported, &prepare_raycast_fragment};
}

}  // namespace triptych::gl_backend
