#include "backends/gl/volume_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "measure/contract/dump.hpp"
#include "measure/contract/not_drawn.hpp"
#include "technique/volume/brick_map.hpp"
#include "technique/volume/packed_cells.hpp"
#include "technique/volume/quadrature_table.hpp"
#include "technique/volume/raycast_buffers.hpp"

namespace triptych::gl_backend {
namespace {

// The bindings of technique/volume/raycast/parameters.glsl, and texture units.
constexpr GLuint binding_volume_parameters = 0;
constexpr GLuint unit_volume = 1;
constexpr GLuint unit_transfer = 2;
constexpr GLuint binding_bricks = 3;
constexpr GLuint binding_quadrature = 6;
constexpr GLuint binding_pauses = 7;

void set_unmipped_clamped(const Api& gl, GLenum target, GLint filter) {
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
  set_unmipped_clamped(gl, GL_TEXTURE_1D, GL_NEAREST);
  gl.TexImage1D(GL_TEXTURE_1D, 0, GL_RGBA32F, static_cast<GLsizei>(function.entries.size()), 0,
                GL_RGBA, GL_FLOAT, function.entries.data());
  gl.check("glTexImage1D");
  texture.record_memory(gl.memory_ledger.image(std::as_bytes(std::span(function.entries)).size()));
  return texture;
}

// Creates the buffer for packed cells, each of which stores the eight voxels around a position
// (packed_cells.hpp). The buffer has space for all cells of the volume or, if the volume is drawn
// in parts, for those of the largest part.
Buffer cell_buffer(const Api& gl, const measure::VolumeWork& work,
                   const std::vector<technique::Part>& parts) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  const std::size_t size = technique::layers_of(work.scene, work.options).largest_part_bytes(parts);
  Buffer buffer = device_buffer(gl, size);
  if (!parts.empty()) return buffer;
  fill_buffer(gl, buffer, size, [&](std::size_t begin, std::span<std::byte> out) {
    technique::fill_packed_cells(grid, begin, out);
  });
  return buffer;
}

Texture texture_of(const Api& gl, const scene::VoxelGrid& grid, bool linear, int slices,
                   const void* voxels) {
  const TexelFormat format = texel_format(grid.format);
  Texture texture(gl);
  gl.BindTexture(GL_TEXTURE_3D, texture.get());
  set_unmipped_clamped(gl, GL_TEXTURE_3D, linear ? GL_LINEAR : GL_NEAREST);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage3D(GL_TEXTURE_3D, 0, static_cast<GLint>(format.internal), grid.size[0], grid.size[1],
                slices, 0, GL_RED, format.type, voxels);
  gl.check("glTexImage3D");
  texture.record_memory(gl.memory_ledger.image(
      technique::slice_layers(grid.size, grid.format).bytes * static_cast<std::uint64_t>(slices)));
  return texture;
}

// Creates the parameter buffer. If the volume is drawn in parts, the buffer has space for a part's
// parameters at the end.
Buffer parameter_buffer(const Api& gl, const measure::VolumeWork& work, bool in_parts) {
  // The shader reads texels as fractions of the largest value that the format can store.
  const double stored_maximum =
      is_packed(work) ? 1 : scene::largest_stored(work.scene.grid->format);
  std::vector<std::byte> bytes =
      technique::raycast_parameters(work.scene, work.options, stored_maximum);
  if (in_parts) bytes.resize(bytes.size() + sizeof(technique::PartParameters));
  return constant_buffer(gl, bytes);
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
    case scene::VoxelFormat::f16:
      return {GL_R16F, GL_HALF_FLOAT};
    case scene::VoxelFormat::f32:
      break;
  }
  return {GL_R32F, GL_FLOAT};
}

Texture volume_texture(const Api& gl, const scene::VoxelGrid& grid, bool linear) {
  return texture_of(gl, grid, linear, grid.size[2], grid.data.data());
}

Buffer constant_buffer(const Api& gl, std::span<const std::byte> bytes) {
  if (measure::dump_folder()) {
    measure::write_dump("buffer", "bin", bytes, fmt::format("a buffer of {} bytes", bytes.size()));
  }
  Buffer buffer(gl);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.get());
  gl.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
                GL_STATIC_DRAW);
  gl.check("glBufferData");
  buffer.record_memory(gl.memory_ledger.buffer(bytes.size()));
  return buffer;
}

Buffer device_buffer(const Api& gl, std::size_t size) {
  Buffer buffer(gl);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.get());
  gl.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(size), nullptr, GL_DYNAMIC_COPY);
  gl.check("glBufferData");
  buffer.record_memory(gl.memory_ledger.buffer(size));
  return buffer;
}

Buffer device_words(const Api& gl, std::size_t count) {
  return device_buffer(gl, sizeof(GLuint) * std::max<std::size_t>(count, 4));
}

void poison_buffer(const Api& gl, const Buffer& buffer) {
  refill_buffer(gl, buffer, measure::poison_word);
}

void refill_buffer(const Api& gl, const Buffer& buffer, GLuint word) {
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.get());
  GLint64 size = 0;
  gl.GetBufferParameteri64v(GL_COPY_WRITE_BUFFER, GL_BUFFER_SIZE, &size);
  fill_buffer(gl, buffer, static_cast<std::size_t>(size),
              [word](std::size_t, std::span<std::byte> out) {
                for (std::size_t at = 0; at + sizeof word <= out.size(); at += sizeof word) {
                  std::memcpy(out.data() + at, &word, sizeof word);
                }
              });
}

// Uploads through a small staging buffer, so that the host never has a second copy of the data.
void fill_buffer(const Api& gl, const Buffer& buffer, std::size_t size, const Fill& fill) {
  constexpr std::size_t piece = std::size_t{1} << 24U;
  std::vector<std::byte> bytes(std::min(piece, size));
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.get());
  for (std::size_t begin = 0; begin < size; begin += piece) {
    const auto filled = std::span(bytes).first(std::min(piece, size - begin));
    fill(begin, filled);
    gl.BufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(begin),
                     static_cast<GLsizeiptr>(filled.size()), filled.data());
  }
  gl.check("glBufferSubData");
}

// If no bricks are skipped, the brick buffer contains a single word. The kernel is compiled from
// the same source as with skipping, but never reads that word.
VolumeData::VolumeData(const Api& gl, const measure::VolumeWork& work,
                       const std::vector<technique::Part>& parts)
    : quadrature_(quadrature_buffer(gl, work.scene)),
      parameters_(parameter_buffer(gl, work, !parts.empty())) {
  const std::vector<std::int32_t> map =
      technique::brick_map(work.scene, work.options.skip, work.options.adapt);
  bricks_ = constant_buffer(gl, std::as_bytes(std::span(map)));
  if (!parts.empty()) {
    parts_.emplace(gl, work, parts, map);
    pauses_ = device_buffer(gl, technique::pauses_bytes(work.scene, work.options));
  }
  if (is_packed(work)) {
    make_texel_views(gl, work, parts);
    return;
  }
  const scene::VoxelGrid& grid = *work.scene.grid;
  const bool linear = work.options.sampler == technique::Sampler::hardware;
  textures_.push_back(
      {unit_volume, GL_TEXTURE_3D,
       parts.empty()
           ? volume_texture(gl, grid, linear)
           : texture_of(gl, grid, false, technique::most_stored_cells(parts) + 1, nullptr)});
  textures_.push_back(
      {unit_transfer, GL_TEXTURE_1D, transfer_texture(gl, work.scene.transfer_function)});
}

void VolumeData::move_part(const Api& gl, int n) const {
  gl.ActiveTexture(GL_TEXTURE0 + unit_volume);
  parts_->move(gl, n, parameters_, cells_.get() != 0 ? &cells_ : nullptr);
}

void VolumeData::make_texel_views(const Api& gl, const measure::VolumeWork& work,
                                  const std::vector<technique::Part>& parts) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  cells_ = cell_buffer(gl, work, parts);
  table_ = constant_buffer(gl, std::as_bytes(std::span(work.scene.transfer_function.entries)));
  const auto add_texel_view = [&](GLuint unit, const Buffer& buffer, GLenum format) {
    Texture texture(gl);
    gl.BindTexture(GL_TEXTURE_BUFFER, texture.get());
    gl.TexBuffer(GL_TEXTURE_BUFFER, format, buffer.get());
    textures_.push_back({unit, GL_TEXTURE_BUFFER, std::move(texture)});
  };
  add_texel_view(unit_volume, cells_,
                 technique::packed_texel_bytes(grid.format) == 8 ? GL_RG32UI : GL_RGBA32UI);
  add_texel_view(unit_transfer, table_, GL_RGBA32F);
  add_texel_view(binding_bricks, bricks_, GL_R32I);
  add_texel_view(binding_quadrature, quadrature_, GL_RGBA32F);
  gl.check("glTexBuffer");
}

void VolumeData::bind(const Api& gl) const {
  for (const BoundTexture& each : textures_) {
    gl.ActiveTexture(GL_TEXTURE0 + each.unit);
    gl.BindTexture(each.target, each.texture.get());
  }
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_bricks, bricks_.get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_quadrature, quadrature_.get());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, binding_volume_parameters, parameters_.get());
  if (parts_) gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_pauses, pauses_.get());
}

}  // namespace triptych::gl_backend
