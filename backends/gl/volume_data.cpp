#include "backends/gl/volume_data.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "technique/volume/brick_map.hpp"
#include "technique/volume/packed_cells.hpp"
#include "technique/volume/quadrature_table.hpp"

namespace triptych::gl_backend {
namespace {

// Bindings of technique/volume/raycast/parameters.glsl, and texture units.
constexpr GLuint binding_parameters = 0;
constexpr GLuint unit_volume = 1;
constexpr GLuint unit_transfer = 2;
constexpr GLuint binding_bricks = 3;
constexpr GLuint binding_quadrature = 6;

void use_texels_as_they_are(const Api& gl, GLenum target, GLint filter) {
  gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
  gl.TexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(target, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
}

Texture transfer_texture(const Api& gl, const scene::TransferFunction& function) {
  Texture texture(gl);
  gl.BindTexture(GL_TEXTURE_1D, texture.get());
  use_texels_as_they_are(gl, GL_TEXTURE_1D, GL_NEAREST);
  gl.TexImage1D(GL_TEXTURE_1D, 0, GL_RGBA32F, static_cast<GLsizei>(function.entries.size()), 0,
                GL_RGBA, GL_FLOAT, function.entries.data());
  gl.check("glTexImage1D");
  texture.holds(gl.held.image(std::as_bytes(std::span(function.entries)).size()));
  return texture;
}

// One word where nothing is skipped: the kernel is the same and never reads it.
Buffer brick_buffer(const Api& gl, const measure::VolumeWork& work) {
  const std::vector<std::int32_t> map =
      technique::brick_map(work.scene, work.options.skip, work.options.adapt);
  return constant_buffer(gl, std::as_bytes(std::span(map)));
}

// Through a small part of it, so that the host never holds a second copy.
Buffer cell_buffer(const Api& gl, const scene::VoxelGrid& grid) {
  constexpr std::size_t part = std::size_t{1} << 24U;
  const std::size_t size = technique::packed_bytes(grid.size, grid.format);
  Buffer buffer = device_buffer(gl, size);
  std::vector<std::byte> bytes(std::min(part, size));
  for (std::size_t begin = 0; begin < size; begin += part) {
    const auto filled = std::span(bytes).first(std::min(part, size - begin));
    technique::fill_packed_cells(grid, begin, filled);
    gl.BufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(begin),
                     static_cast<GLsizeiptr>(filled.size()), filled.data());
  }
  gl.check("glBufferSubData");
  return buffer;
}

Buffer quadrature_buffer(const Api& gl, const scene::VolumeScene& scene) {
  const technique::QuadratureTable table = technique::quadrature_table(scene);
  return constant_buffer(gl, std::as_bytes(std::span(table)));
}

}  // namespace

TexelFormat texel_format(scene::VoxelFormat format) {
  switch (format) {
    case scene::VoxelFormat::u8:
      return {GL_R8, GL_UNSIGNED_BYTE};
    case scene::VoxelFormat::u16:
      return {GL_R16, GL_UNSIGNED_SHORT};
    case scene::VoxelFormat::f32:
      break;
  }
  return {GL_R32F, GL_FLOAT};
}

Texture volume_texture(const Api& gl, const scene::VoxelGrid& grid, bool linear) {
  const TexelFormat format = texel_format(grid.format);
  Texture texture(gl);
  gl.BindTexture(GL_TEXTURE_3D, texture.get());
  use_texels_as_they_are(gl, GL_TEXTURE_3D, linear ? GL_LINEAR : GL_NEAREST);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage3D(GL_TEXTURE_3D, 0, static_cast<GLint>(format.internal), grid.size[0], grid.size[1],
                grid.size[2], 0, GL_RED, format.type, grid.data.data());
  gl.check("glTexImage3D");
  texture.holds(gl.held.image(grid.data.size()));
  return texture;
}

Buffer constant_buffer(const Api& gl, std::span<const std::byte> bytes) {
  Buffer buffer(gl);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.get());
  gl.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
                GL_STATIC_DRAW);
  gl.check("glBufferData");
  buffer.holds(gl.held.buffer(bytes.size()));
  return buffer;
}

Buffer device_buffer(const Api& gl, std::size_t size) {
  Buffer buffer(gl);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.get());
  gl.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(size), nullptr, GL_DYNAMIC_COPY);
  gl.check("glBufferData");
  buffer.holds(gl.held.buffer(size));
  return buffer;
}

VolumeData::VolumeData(const Api& gl, const measure::VolumeWork& work)
    : bricks_(brick_buffer(gl, work)), quadrature_(quadrature_buffer(gl, work.scene)) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  // A texel of an image reaches the shader divided by its format's largest.
  parameters_ = constant_buffer(
      gl, technique::raycast_parameters(work.scene, work.options,
                                        is_packed(work) ? 1 : scene::largest_stored(grid.format)));
  if (is_packed(work)) {
    see_texels(gl, work);
    return;
  }
  const bool linear = work.options.sampler == technique::Sampler::hardware;
  textures_.push_back({unit_volume, GL_TEXTURE_3D, volume_texture(gl, grid, linear)});
  textures_.push_back(
      {unit_transfer, GL_TEXTURE_1D, transfer_texture(gl, work.scene.transfer_function)});
}

void VolumeData::see_texels(const Api& gl, const measure::VolumeWork& work) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  cells_ = cell_buffer(gl, grid);
  table_ = constant_buffer(gl, std::as_bytes(std::span(work.scene.transfer_function.entries)));
  const auto see = [&](GLuint unit, const Buffer& buffer, GLenum format) {
    Texture texture(gl);
    gl.BindTexture(GL_TEXTURE_BUFFER, texture.get());
    gl.TexBuffer(GL_TEXTURE_BUFFER, format, buffer.get());
    textures_.push_back({unit, GL_TEXTURE_BUFFER, std::move(texture)});
  };
  see(unit_volume, cells_,
      technique::packed_texel_bytes(grid.format) == 8 ? GL_RG32UI : GL_RGBA32UI);
  see(unit_transfer, table_, GL_RGBA32F);
  see(binding_bricks, bricks_, GL_R32I);
  see(binding_quadrature, quadrature_, GL_RGBA32F);
  gl.check("glTexBuffer");
}

void VolumeData::bind(const Api& gl) const {
  for (const Seen& each : textures_) {
    gl.ActiveTexture(GL_TEXTURE0 + each.unit);
    gl.BindTexture(each.target, each.texture.get());
  }
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_bricks, bricks_.get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_quadrature, quadrature_.get());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, binding_parameters, parameters_.get());
}

}  // namespace triptych::gl_backend
