#pragma once
#include <span>
#include <vector>

#include "backends/gl/objects.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// A draw command per cell, in the order of the arrangement: for all of each cell's particles, until
// cull.comp.glsl has left out those of cells that are not in sight.
class CellDraws {
 public:
  // `instanced`: a cell's particles are instances of four vertices, else vertices.
  CellDraws(const Api& gl, std::span<const technique::Cell> cells, bool instanced);

  // Makes cells and commands bindings 6 and 7, and runs the culling program that is in use.
  void cull(const Api& gl) const;
  void draw(const Api& gl, GLenum mode) const;
  // Makes every command draw nothing, so that a frame without culling shows nothing.
  void poison(const Api& gl) const;

 private:
  GLsizei count_;
  Buffer cells_;
  Buffer commands_;
};

// The same cells with about one in `stride` of their particles, evenly spread.
[[nodiscard]] std::vector<technique::Cell> thinned(std::span<const technique::Cell> cells,
                                                   int stride);

}  // namespace triptych::gl_backend
