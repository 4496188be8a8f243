#pragma once
#include <array>
#include <span>
#include <vector>

#include "backends/gl/objects.hpp"
#include "technique/particles/hierarchy.hpp"

namespace triptych::gl_backend {

// Creates a buffer texture with the format GL_R32UI or GL_RGBA32F, through which shaders read the
// buffer. Throws core::NotSupported if the buffer has more texels than the device allows.
[[nodiscard]] Texture texels_of(const Api& gl, const Buffer& buffer, std::size_t words,
                                GLenum format);

// The buffers that the passes of technique/particles/hierarchy.glsl write and read.
class HierarchyData {
 public:
  HierarchyData(const Api& gl, const technique::Hierarchy& hierarchy, std::uint32_t beams);

  // Binds storage blocks 7…10 and 12, and texture units 13…15.
  void bind(const Api& gl) const;
  // Returns whether the traversal of every beam has ended. A beam consists of the rays of 4×2
  // pixels, which one invocation traces (bvh.comp.glsl, TRI_STEP).
  [[nodiscard]] bool all_ended(const Api& gl) const;

 private:
  std::uint32_t beams_;
  Buffer boxes_;
  Buffer tree_spheres_;
  Buffer tree_order_;
  Buffer sorted_;
  Buffer scratch_;
  std::array<Texture, 3> texels_;
};

}  // namespace triptych::gl_backend
