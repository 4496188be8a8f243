#pragma once
#include <span>
#include <vector>

#include "backends/gl/objects.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// One draw command for each cell, in the order of the arrangement. A command draws all particles of
// its cell, unless cull.comp.glsl found that the cell is out of sight.
class CellDraws {
 public:
  // `instanced`: draw each particle of a cell as an instance with four vertices, rather than as one
  // vertex.
  CellDraws(const Api& gl, std::span<const technique::Cell> cells, bool instanced);

  // Binds the cells to binding 6 and the commands to binding 7, and dispatches the current program,
  // which must be the culling program.
  void cull(const Api& gl) const;
  void draw(const Api& gl, GLenum mode) const;
  // Makes every command draw nothing, so that a frame without culling shows nothing.
  void poison(const Api& gl) const;

 private:
  GLsizei count_;
  Buffer cells_;
  Buffer commands_;
};

// Returns the cells with their particle counts reduced by the factor `stride`. The counts are
// rounded so that all cells together contain one in `stride` of the particles.
[[nodiscard]] std::vector<technique::Cell> thinned(std::span<const technique::Cell> cells,
                                                   int stride);

}  // namespace triptych::gl_backend
