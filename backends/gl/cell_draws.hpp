#pragma once
#include <span>
#include <vector>

#include "backends/gl/objects.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// One draw command for each cell, in the order of the arrangement. It draws all particles of the
// cell, unless cull.comp.glsl has removed those of cells that are out of sight.
class CellDraws {
 public:
  // `instanced`: each particle of a cell is an instance of four vertices; otherwise it is one
  // vertex.
  CellDraws(const Api& gl, std::span<const technique::Cell> cells, bool instanced);

  // Binds cells and commands to bindings 6 and 7, and runs the current program, which does the
  // culling.
  void cull(const Api& gl) const;
  void draw(const Api& gl, GLenum mode) const;
  // Makes every command draw nothing, so that a frame without culling shows nothing.
  void poison(const Api& gl) const;

 private:
  GLsizei count_;
  Buffer cells_;
  Buffer commands_;
};

// The same cells, but each with only about one of `stride` particles, evenly distributed.
[[nodiscard]] std::vector<technique::Cell> thinned(std::span<const technique::Cell> cells,
                                                   int stride);

}  // namespace triptych::gl_backend
