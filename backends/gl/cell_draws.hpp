#pragma once
#include <span>
#include <vector>

#include "backends/gl/objects.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// One draw command for each cell, in the order of technique::Arrangement. A cell is a range of
// neighbouring particles. Its command draws all of them, unless cull.comp.glsl found that the cell
// is out of sight.
class CellDraws {
 public:
  // If `instanced` is true, each particle of a cell is drawn as an instance with four vertices;
  // otherwise as a single vertex.
  CellDraws(const Api& gl, std::span<const technique::Cell> cells, bool instanced);

  // Binds the cells to binding 6 and the commands to binding 7, and dispatches the current program,
  // which must be the culling program.
  void cull(const Api& gl) const;
  void draw(const Api& gl, GLenum mode) const;
  // Overwrites the commands so that they draw nothing. If a frame then fails to run the culling
  // pass, its image is empty instead of showing the result of an earlier pass.
  void poison(const Api& gl) const;

 private:
  GLsizei count_;
  Buffer cells_;
  Buffer commands_;
};

// Returns the given cells, but with only about 1/stride of the particles of each cell. The counts
// are rounded so that all returned cells together contain one in `stride` of the particles.
[[nodiscard]] std::vector<technique::Cell> thinned(std::span<const technique::Cell> cells,
                                                   int stride);

}  // namespace triptych::gl_backend
