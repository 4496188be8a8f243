#include "backends/gl/cell_draws.hpp"

#include "backends/gl/volume_data.hpp"

namespace triptych::gl_backend {
namespace {

// The bindings and the work-group size of technique/particles/cull.comp.glsl.
constexpr GLuint binding_cells = 6;
constexpr GLuint binding_commands = 7;
constexpr GLuint cull_group_size = 64;

// DrawArraysIndirectCommand of the OpenGL specification.
struct DrawCommand {
  GLuint vertices = 0;
  GLuint instances = 0;
  GLuint first_vertex = 0;
  GLuint first_instance = 0;
};
static_assert(sizeof(DrawCommand) == 16);

std::vector<DrawCommand> all_drawn(std::span<const technique::Cell> cells, bool instanced) {
  std::vector<DrawCommand> commands;
  commands.reserve(cells.size());
  for (const technique::Cell& cell : cells) {
    commands.push_back(instanced ? DrawCommand{4, cell.count, 0, cell.begin}
                                 : DrawCommand{cell.count, 1, cell.begin, 0});
  }
  return commands;
}

}  // namespace

CellDraws::CellDraws(const Api& gl, std::span<const technique::Cell> cells, bool instanced)
    : count_(static_cast<GLsizei>(cells.size())) {
  if (count_ == 0) return;
  cells_ = constant_buffer(gl, std::as_bytes(cells));
  const std::vector<DrawCommand> commands = all_drawn(cells, instanced);
  commands_ = constant_buffer(gl, std::as_bytes(std::span(commands)));
}

void CellDraws::cull(const Api& gl) const {
  if (count_ == 0) return;
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_cells, cells_.get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_commands, commands_.get());
  gl.DispatchCompute((static_cast<GLuint>(count_) + cull_group_size - 1) / cull_group_size, 1, 1);
}

void CellDraws::draw(const Api& gl, GLenum mode) const {
  if (count_ == 0) return;
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.get());
  gl.MultiDrawArraysIndirect(mode, nullptr, count_, 0);
}

void CellDraws::poison(const Api& gl) const {
  if (count_ > 0) refill_buffer(gl, commands_, 0);
}

std::vector<technique::Cell> thinned(std::span<const technique::Cell> cells, int stride) {
  std::vector<technique::Cell> fewer(cells.begin(), cells.end());
  const auto every = static_cast<std::uint32_t>(stride);
  for (technique::Cell& cell : fewer) {
    cell.count = (cell.begin + cell.count) / every - cell.begin / every;
  }
  return fewer;
}

}  // namespace triptych::gl_backend
