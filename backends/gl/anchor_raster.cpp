// Layers of triangles added up in a target of bytes.
#include <fmt/format.h>

#include <array>
#include <vector>

#include "backends/gl/framebuffer.hpp"
#include "backends/gl/program.hpp"
#include "backends/gl/techniques.hpp"
#include "technique/anchors/anchor_work.hpp"
#include "technique/anchors/shape.hpp"

namespace triptych::gl_backend {
namespace {

constexpr std::string_view id = "anchor_raster";
constexpr auto edge = static_cast<GLsizei>(technique::anchor_shape::raster_edge);

class RasterDrawing final : public Drawing {
 public:
  RasterDrawing(const Api& gl, const measure::AnchorWork& work)
      : vertices_(static_cast<GLsizei>(technique::anchor_frame(id, work.size).vertices)),
        no_vertices_(gl),
        pixels_(pixels(gl, GL_RGBA8, edge, edge)),
        framebuffer_(gl) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                               pixels_.get());
    check_framebuffer(gl);
    const std::array stages{
        Stage{GL_VERTEX_SHADER, anchor_source(gl, "anchor_raster.vert.glsl")},
        Stage{GL_FRAGMENT_SHADER, anchor_source(gl, "anchor_raster.frag.glsl")}};
    program_ = link(gl, stages);
    hash_ = hash_of(gl, std::array{stages[0].source, stages[1].source});
  }

  [[nodiscard]] std::span<const Statistic> statistics() const override {
    static constexpr std::array<Statistic, 6> told{{
        {GL_VERTICES_SUBMITTED_ARB, "input_assembly_vertices"},
        {GL_PRIMITIVES_SUBMITTED_ARB, "input_assembly_primitives"},
        {GL_VERTEX_SHADER_INVOCATIONS_ARB, "vertex_invocations"},
        {GL_CLIPPING_INPUT_PRIMITIVES_ARB, "clipping_invocations"},
        {GL_CLIPPING_OUTPUT_PRIMITIVES_ARB, "clipping_primitives"},
        {GL_FRAGMENT_SHADER_INVOCATIONS_ARB, "fragment_invocations"},
    }};
    return told;
  }

  void bind(const Api& gl, measure::Purpose) override {
    gl.UseProgram(program_.get());
    gl.BindVertexArray(no_vertices_.get());
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    gl.Viewport(0, 0, edge, edge);
    gl.Disable(GL_DEPTH_TEST);
  }

  // Blending is on for this draw alone: no other technique knows of it.
  void submit(const Api& gl, measure::Purpose) override {
    constexpr std::array<float, 4> zeros{};
    gl.ClearBufferfv(GL_COLOR, 0, zeros.data());
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    gl.DrawArrays(GL_TRIANGLES, 0, vertices_);
    gl.Disable(GL_BLEND);
  }

  [[nodiscard]] record::Counts counters(const Api& gl) const override {
    std::vector<std::uint8_t> bytes(std::size_t{4} * edge * edge);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, edge, edge, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    gl.check("glReadPixels");
    std::uint32_t sum = 0;
    for (std::size_t red = 0; red < bytes.size(); red += 4) sum += bytes[red];
    return {{std::string(technique::anchor_counter), sum}};
  }

  [[nodiscard]] core::Image read(const Api&) const override { return {}; }
  [[nodiscard]] std::string kernel_hash() const override { return hash_; }

 private:
  GLsizei vertices_;
  VertexArray no_vertices_;  // the core profile draws nothing without one
  Renderbuffer pixels_;
  Framebuffer framebuffer_;
  Program program_;
  std::string hash_;
};

std::optional<std::string> unsupported(const Api& gl, const measure::AnchorWork& work) {
  if (auto reason = technique::anchor_size_reason(id, work.size)) return reason;
  const std::int64_t most = gl.limit(GL_MAX_RENDERBUFFER_SIZE);
  if (edge > most) {
    return fmt::format("{0}x{0} pixels, GL_MAX_RENDERBUFFER_SIZE is {1}", edge, most);
  }
  return std::nullopt;
}

std::unique_ptr<Drawing> make(const Api& gl, const measure::AnchorWork& work) {
  return std::make_unique<RasterDrawing>(gl, work);
}

}  // namespace

AnchorTechnique anchor_raster() {
  return {&unsupported, &make};
}

}  // namespace triptych::gl_backend
