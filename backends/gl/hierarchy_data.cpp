#include "backends/gl/hierarchy_data.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "backends/gl/volume_data.hpp"
#include "core/error.hpp"

namespace triptych::gl_backend {
namespace {

// Bindings of technique/particles/hierarchy.glsl and bvh.comp.glsl.
constexpr GLuint binding_boxes = 7;
constexpr GLuint binding_tree_spheres = 8;
constexpr GLuint binding_tree_order = 9;
constexpr GLuint binding_sorted = 10;
constexpr GLuint binding_tree_scratch = 12;
constexpr GLuint first_tree_texels = 13;  // of three texture units: boxes, spheres, order

constexpr std::size_t tree_word = sizeof(GLuint);

}  // namespace

Texture texels_of(const Api& gl, const Buffer& buffer, std::size_t words, GLenum format) {
  const std::size_t texels = words / (format == GL_R32UI ? 1 : 4);
  const auto most = static_cast<std::size_t>(gl.limit(GL_MAX_TEXTURE_BUFFER_SIZE));
  if (texels > most) {
    throw core::NotSupported(fmt::format(
        "needs a buffer texture of {} texels, but GL_MAX_TEXTURE_BUFFER_SIZE is {}", texels, most));
  }
  Texture texture(gl);
  gl.BindTexture(GL_TEXTURE_BUFFER, texture.get());
  gl.TexBuffer(GL_TEXTURE_BUFFER, format, buffer.get());
  gl.check("glTexBuffer");
  return texture;
}

HierarchyData::HierarchyData(const Api& gl, const technique::Hierarchy& hierarchy,
                             std::uint32_t beams)
    : beams_(beams),
      boxes_(device_words(gl, hierarchy.box_words())),
      tree_spheres_(device_words(gl, hierarchy.sphere_words())),
      tree_order_(device_words(gl, hierarchy.order_words())),
      sorted_(device_words(gl, hierarchy.sorted_words())),
      scratch_(device_words(
          gl, std::max<std::size_t>(hierarchy.scratch_words(), 2 * std::size_t{beams}))),
      texels_{texels_of(gl, boxes_, hierarchy.box_words(), GL_RGBA32F),
              texels_of(gl, tree_spheres_, hierarchy.sphere_words(), GL_RGBA32F),
              texels_of(gl, tree_order_, hierarchy.order_words(), GL_R32UI)} {}

void HierarchyData::bind(const Api& gl) const {
  const auto use = [&](GLuint binding, const Buffer& buffer) {
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.get());
  };
  use(binding_boxes, boxes_);
  use(binding_tree_spheres, tree_spheres_);
  use(binding_tree_order, tree_order_);
  use(binding_sorted, sorted_);
  use(binding_tree_scratch, scratch_);
  for (GLuint n = 0; n < texels_.size(); ++n) {
    gl.ActiveTexture(GL_TEXTURE0 + first_tree_texels + n);
    gl.BindTexture(GL_TEXTURE_BUFFER, texels_.at(n).get());
  }
  gl.ActiveTexture(GL_TEXTURE0);
}

bool HierarchyData::all_ended(const Api& gl) const {
  std::vector<GLuint> states(2 * std::size_t{beams_});
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.BindBuffer(GL_COPY_READ_BUFFER, scratch_.get());
  gl.GetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(tree_word * states.size()),
                      states.data());
  gl.check("glGetBufferSubData");
  for (std::size_t beam = 0; beam < beams_; ++beam) {
    if (states[2 * beam] != 0) return false;
  }
  return true;
}

}  // namespace triptych::gl_backend
