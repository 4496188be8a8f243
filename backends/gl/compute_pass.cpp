#include "backends/gl/compute_pass.hpp"

#include <fmt/format.h>

#include <array>

#include "backends/gl/standalone.hpp"
#include "technique/volume/extra_work.hpp"

namespace triptych::gl_backend {
namespace {

constexpr GLuint binding_pixels = 4;  // the binding in shaders/raycast.comp

constexpr GLuint groups(int size) {
  return static_cast<GLuint>((size + group_edge - 1) / group_edge);
}

}  // namespace

ComputePass::ComputePass(const Api& gl, int width, int height, int extra_work_stride)
    : width_(width),
      height_(height),
      drawn_columns_(technique::drawn_columns(width, extra_work_stride)),
      pixels_(device_buffer(gl, 4 * sizeof(float) *
                                    static_cast<std::size_t>(technique::drawn_pixels(
                                        width, height, extra_work_stride)))) {}

std::optional<std::string> storage_unsupported(const Api& gl) {
  if (gl.VERSION_4_3 != 0 ||
      (gl.ARB_shader_storage_buffer_object != 0 && gl.ARB_shading_language_420pack != 0 &&
       (gl.VERSION_4_2 != 0 || gl.ARB_shader_image_load_store != 0))) {
    return std::nullopt;
  }
  return "storage blocks need OpenGL 4.3, or GL_ARB_shader_storage_buffer_object together with "
         "GL_ARB_shading_language_420pack and GL_ARB_shader_image_load_store";
}

std::optional<std::string> ComputePass::unsupported(const Api& gl, int width, int height) {
  if (gl.VERSION_4_3 == 0 && gl.ARB_compute_shader == 0) {
    return "compute shaders need OpenGL 4.3 or GL_ARB_compute_shader";
  }
  if (auto reason = storage_unsupported(gl)) return reason;
  const std::array<int, 2> size{width, height};
  for (GLuint axis = 0; axis < size.size(); ++axis) {
    const std::int64_t needed = groups(size[axis]);
    const std::int64_t most = gl.limit(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis);
    if (needed > most) {
      return fmt::format(
          "{}x{} pixels need {} work groups, but GL_MAX_COMPUTE_WORK_GROUP_COUNT is {}", width,
          height, needed, most);
    }
  }
  return std::nullopt;
}

std::vector<Stage> ComputePass::stages(const Api& gl, const Constants& constants) const {
  return {volume_stage(gl, GL_COMPUTE_SHADER, constants, "raycast.comp")};
}

std::span<const Statistic> ComputePass::statistics() const {
  static constexpr std::array<Statistic, 1> wanted{
      {{GL_COMPUTE_SHADER_INVOCATIONS_ARB, "compute_invocations"}}};
  return wanted;
}

void ComputePass::dump(const measure::VolumeWork& work, const std::string& source) const {
  dump_standalone(work, source, groups(drawn_columns_), groups(height_));
}

void ComputePass::bind(const Api& gl) {
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_pixels, pixels_.get());
}

void ComputePass::submit(const Api& gl, measure::Purpose purpose) {
  const int columns = purpose == measure::Purpose::counters ? width_ : drawn_columns_;
  gl.DispatchCompute(groups(columns), groups(height_), 1);
}

core::Image ComputePass::read(const Api& gl) const {
  core::Image image(width_, height_);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.BindBuffer(GL_COPY_READ_BUFFER, pixels_.get());
  gl.GetBufferSubData(GL_COPY_READ_BUFFER, 0,
                      static_cast<GLsizeiptr>(image.rgba.size() * sizeof(float)),
                      image.rgba.data());
  gl.check("glGetBufferSubData");
  return image;
}

}  // namespace triptych::gl_backend
