#include "backends/gl/anchor_drawing.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "backends/gl/compute_pass.hpp"
#include "backends/gl/volume_data.hpp"
#include "technique/anchors/shape.hpp"

namespace triptych::gl_backend {
namespace {

scene::VoxelGrid volume_grid() {
  constexpr auto edge = static_cast<int>(technique::anchor_shape::fetch_edge);
  const std::vector<float> voxels = technique::anchor_volume();
  scene::VoxelGrid grid;
  grid.format = scene::VoxelFormat::f32;
  grid.size = {edge, edge, edge};
  grid.data.resize(voxels.size() * sizeof(float));
  std::memcpy(grid.data.data(), voxels.data(), grid.data.size());
  return grid;
}

}  // namespace

std::optional<std::string> anchor_unsupported(const Api& gl, std::string_view technique,
                                              const measure::AnchorWork& work) {
  if (auto reason = technique::anchor_size_reason(technique, work.size)) return reason;
  if (auto reason = ComputePass::unsupported(gl, 1, 1)) return reason;
  const std::uint64_t bytes =
      sizeof(std::uint32_t) * technique::anchor_frame(technique, work.size).result_words;
  const std::int64_t most = gl.limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
  if (bytes > static_cast<std::uint64_t>(most)) {
    return fmt::format("{} bytes in one block, GL_MAX_SHADER_STORAGE_BLOCK_SIZE is {}", bytes,
                       most);
  }
  return std::nullopt;
}

AnchorDrawing::AnchorDrawing(const Api& gl, std::string_view technique,
                             const measure::AnchorWork& work)
    : shape_(technique::anchor_frame(technique, work.size)),
      parameters_(constant_buffer(gl, std::as_bytes(std::span(&shape_.parameters, 1)))),
      results_(device_buffer(gl, sizeof(std::uint32_t) * shape_.result_words)) {
  const Stage stage{GL_COMPUTE_SHADER, anchor_source(gl, std::string(technique) + ".comp.glsl")};
  program_ = link(gl, std::span(&stage, 1));
  hash_ = hash_of(gl, std::span(&stage.source, 1));
  if (shape_.source_words > 0) {
    const std::vector<std::uint32_t> source = technique::anchor_source(shape_.source_words);
    source_ = constant_buffer(gl, std::as_bytes(std::span(source)));
  }
  if (shape_.fetches) volume_ = volume_texture(gl, volume_grid(), true);
}

std::span<const Statistic> AnchorDrawing::statistics() const {
  static constexpr std::array<Statistic, 1> told{
      {{GL_COMPUTE_SHADER_INVOCATIONS_ARB, "compute_invocations"}}};
  return told;
}

void AnchorDrawing::bind(const Api& gl, measure::Purpose purpose) {
  gl.UseProgram(program_.get());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, technique::anchor_parameters_binding, parameters_.get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, technique::anchor_results_binding, results_.get());
  if (shape_.source_words > 0) {
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, technique::anchor_source_binding, source_.get());
  }
  if (shape_.fetches) {
    gl.ActiveTexture(GL_TEXTURE0 + technique::anchor_volume_binding);
    gl.BindTexture(GL_TEXTURE_3D, volume_.get());
  }
  if (purpose == measure::Purpose::counters) {
    const std::vector<std::uint32_t> zeros(shape_.result_words);
    gl.BindBuffer(GL_COPY_WRITE_BUFFER, results_.get());
    gl.BufferSubData(GL_COPY_WRITE_BUFFER, 0,
                     static_cast<GLsizeiptr>(std::span(zeros).size_bytes()), zeros.data());
  }
}

void AnchorDrawing::submit(const Api& gl, measure::Purpose) {
  for (std::uint32_t i = 0; i < shape_.launches; ++i) gl.DispatchCompute(shape_.groups, 1, 1);
}

record::Counts AnchorDrawing::counters(const Api& gl) const {
  std::vector<std::uint32_t> words(shape_.result_words);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, results_.get());
  gl.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
                      static_cast<GLsizeiptr>(std::span(words).size_bytes()), words.data());
  gl.check("glGetBufferSubData");
  return {{std::string(technique::anchor_counter), technique::anchor_checksum(words)}};
}

}  // namespace triptych::gl_backend
