#include "backends/gl/volume_parts.hpp"

#include <algorithm>
#include <string>

#include "backends/gl/volume_data.hpp"
#include "technique/volume/long_rays.hpp"
#include "technique/volume/packed_cells.hpp"

namespace triptych::gl_backend {
namespace {

bool can_store(const Api& gl, const std::array<int, 3>& size, scene::VoxelFormat format) {
  const TexelFormat texel = texel_format(format);
  gl.TexImage3D(GL_PROXY_TEXTURE_3D, 0, static_cast<GLint>(texel.internal), size[0], size[1],
                size[2], 0, GL_RED, texel.type, nullptr);
  GLint accepted = 0;
  gl.GetTexLevelParameteriv(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_WIDTH, &accepted);
  gl.check("glTexImage3D");
  return accepted != 0;
}

// Returns the memory available for voxels under the device's limits, and the name of the decisive
// limit.
technique::MemoryLimit memory_limit(const Api& gl, const measure::VolumeWork& work) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  if (is_packed(work)) {
    const auto texels = static_cast<std::uint64_t>(gl.limit(GL_MAX_TEXTURE_BUFFER_SIZE));
    return {texels * technique::packed_texel_bytes(grid.format),
            "the limit derived from GL_MAX_TEXTURE_BUFFER_SIZE"};
  }
  const auto edge = static_cast<int>(gl.limit(GL_MAX_3D_TEXTURE_SIZE));
  std::string limit = "the limit derived from GL_MAX_3D_TEXTURE_SIZE";
  if (std::max(grid.size[0], grid.size[1]) > edge) return {0, limit};
  int depth = std::min(grid.size[2], edge);
  while (depth > 0 && !can_store(gl, {grid.size[0], grid.size[1], depth}, grid.format)) {
    depth /= 2;
    limit = "the limit found with GL_PROXY_TEXTURE_3D";
  }
  return {technique::layers_of(work.scene, work.options).bytes * static_cast<std::uint64_t>(depth),
          limit};
}

}  // namespace

bool can_store_whole(const Api& gl, const std::array<int, 3>& size, scene::VoxelFormat format) {
  return std::ranges::max(size) <= gl.limit(GL_MAX_3D_TEXTURE_SIZE) && can_store(gl, size, format);
}

technique::Cut cut_of(const Api& gl, std::string_view technique, const measure::VolumeWork& work) {
  const technique::Cut cut = technique::cut_into_parts(
      technique, work.scene, work.options, technique::layers_of(work.scene, work.options),
      technique::within_budget(memory_limit(gl, work), work.options));
  if (cut.parts.empty() || !technique::has_long_rays(work.scene)) return cut;
  return {.parts = {}, .reason = std::string(technique::long_rays_in_parts)};
}

VolumeParts::VolumeParts(const Api& gl, const measure::VolumeWork& work,
                         const std::vector<technique::Part>& parts,
                         std::span<const std::int32_t> map)
    : grid_(work.scene.grid),
      layers_(technique::layers_of(work.scene, work.options)),
      passes_(technique::part_passes(parts, work.scene, work.options, map)),
      place_(technique::raycast_parameters(work.scene, work.options, 1).size()),
      moved_(gl.memory_ledger.moved(technique::moved_bytes(passes_, layers_))) {}

void VolumeParts::move(const Api& gl, int n, const Buffer& parameters, const Buffer* cells) const {
  const auto& [part, its, read] = passes_.at(static_cast<std::size_t>(n));
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, parameters.get());
  gl.BufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(place_), sizeof its, &its);
  if (!read) return;
  if (cells != nullptr) {
    fill_cells(gl, part, *cells);
    return;
  }
  const technique::Slices slices = technique::slices_of(part, *grid_);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, grid_->size[0], grid_->size[1], slices.count, GL_RED,
                   texel_format(grid_->format).type, slices.bytes.data());
  gl.check("glTexSubImage3D");
}

void VolumeParts::fill_cells(const Api& gl, const technique::Part& part,
                             const Buffer& cells) const {
  const std::size_t before = layers_.bytes * static_cast<std::size_t>(part.first_stored);
  fill_buffer(gl, cells, layers_.bytes_of(part.stored_cells()),
              [&](std::size_t begin, std::span<std::byte> out) {
                technique::fill_packed_cells(*grid_, before + begin, out);
              });
}

}  // namespace triptych::gl_backend
