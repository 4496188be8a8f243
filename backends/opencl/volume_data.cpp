#include "backends/opencl/volume_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "core/error.hpp"

namespace triptych::opencl_backend {
namespace {

std::size_t to_size(int n) {
  return static_cast<std::size_t>(n);
}

cl_channel_type channel_type(scene::VoxelFormat voxel) {
  switch (voxel) {
    case scene::VoxelFormat::u8:
      return CL_UNORM_INT8;
    case scene::VoxelFormat::u16:
      return CL_UNORM_INT16;
    case scene::VoxelFormat::f32:
      return CL_FLOAT;
    case scene::VoxelFormat::f16:
      return CL_HALF_FLOAT;
  }
  return CL_FLOAT;
}

// Writes the k-th slice of the bordered volume to `slice`: slice k − 1 of the grid (clamped),
// surrounded by a border.
void copy_bordered_slice(const scene::VoxelGrid& grid, int k, std::vector<std::byte>& slice) {
  const std::size_t bytes = scene::bytes_of(grid.format);
  const auto [nx, ny, nz] = grid.size;
  const std::size_t row_bytes = to_size(nx) * bytes;
  const std::size_t z = to_size(std::clamp(k - 1, 0, nz - 1));
  std::byte* to = slice.data();
  for (int j = 0; j < ny + 2; ++j) {
    const std::size_t y = to_size(std::clamp(j - 1, 0, ny - 1));
    const std::byte* row = grid.data.data() + (z * to_size(ny) + y) * row_bytes;
    std::memcpy(to, row, bytes);
    std::memcpy(to + bytes, row, row_bytes);
    std::memcpy(to + bytes + row_bytes, row + row_bytes - bytes, bytes);
    to += row_bytes + 2 * bytes;
  }
}

cl::Buffer upload_buffer(const Session& session, const scene::VoxelGrid& grid) {
  const technique::Layers layers = bordered_layers(grid);
  const cl::Buffer buffer = make_buffer(session, CL_MEM_READ_ONLY, layers.whole);
  write_layers(session, buffer, grid, 0, grid.size[2] + 1);
  return buffer;
}

// Stores each voxel as the first of four channels.
std::vector<std::byte> as_rgba(std::span<const std::byte> voxels, std::size_t bytes) {
  std::vector<std::byte> result(4 * voxels.size());
  for (std::size_t at = 0; at < voxels.size(); at += bytes) {
    std::memcpy(result.data() + 4 * at, voxels.data() + at, bytes);
  }
  return result;
}

cl::Image3D upload_image(const Session& session, const scene::VoxelGrid& grid) {
  const auto format = image_format(session, grid.format);
  if (!format) throw core::NotSupported("the device has no 3D image format for these voxels");
  const std::array<std::size_t, 3> size{to_size(grid.size[0]), to_size(grid.size[1]),
                                        to_size(grid.size[2])};
  const cl::Image3D image = make_image(session, *format, size);
  const std::size_t slice = size[0] * size[1] * scene::bytes_of(grid.format);
  for (std::size_t k = 0; k < size[2]; ++k) {
    const std::span voxels(grid.data.data() + k * slice, slice);
    const auto write = [&](const std::byte* data) {
      write_image(session, image, {0, 0, k}, {size[0], size[1], 1}, data);
    };
    if (format->image_channel_order == CL_RGBA) {
      write(as_rgba(voxels, scene::bytes_of(grid.format)).data());
    } else {
      write(voxels.data());
    }
  }
  return image;
}

}  // namespace

std::optional<cl::ImageFormat> image_format(const Session& session, scene::VoxelFormat voxel) {
  std::vector<cl::ImageFormat> formats;
  checked([&] {
    session.context.getSupportedImageFormats(CL_MEM_READ_ONLY, CL_MEM_OBJECT_IMAGE3D, &formats);
  });
  for (const cl_channel_order order :
       std::array<cl_channel_order, 4>{CL_R, CL_INTENSITY, CL_LUMINANCE, CL_RGBA}) {
    const auto found = std::ranges::find_if(formats, [&](const cl::ImageFormat& each) {
      return each.image_channel_order == order &&
             each.image_channel_data_type == channel_type(voxel);
    });
    if (found != formats.end()) return *found;
  }
  return std::nullopt;
}

technique::Layers bordered_layers(const scene::VoxelGrid& grid) {
  const std::uint64_t layer =
      (to_size(grid.size[0]) + 2) * (to_size(grid.size[1]) + 2) * scene::bytes_of(grid.format);
  return {.bytes = layer, .more = 1, .whole = layer * (to_size(grid.size[2]) + 2)};
}

void write_layers(const Session& session, const cl::Buffer& buffer, const scene::VoxelGrid& grid,
                  int first, int cells) {
  const technique::Layers layers = bordered_layers(grid);
  std::vector<std::byte> slice(layers.bytes);
  for (int k = 0; k < cells + layers.more; ++k) {
    copy_bordered_slice(grid, first + k, slice);
    write_buffer(session, buffer, to_size(k) * slice.size(), slice.size(), slice.data());
  }
}

std::vector<std::byte> uploaded_voxels(const Session& session, const scene::VoxelGrid& grid,
                                       technique::Sampler sampler) {
  if (sampler != technique::Sampler::manual) {
    const auto format = image_format(session, grid.format);
    const bool rgba = format && format->image_channel_order == CL_RGBA;
    if (rgba) return as_rgba(grid.data, scene::bytes_of(grid.format));
    return {grid.data.begin(), grid.data.end()};
  }
  std::vector<std::byte> bytes;
  std::vector<std::byte> slice(bordered_layers(grid).bytes);
  for (int k = 0; k < grid.size[2] + 2; ++k) {
    copy_bordered_slice(grid, k, slice);
    bytes.insert(bytes.end(), slice.begin(), slice.end());
  }
  return bytes;
}

double stored_maximum(scene::VoxelFormat voxel, technique::Sampler sampler) {
  return sampler == technique::Sampler::manual ? 1 : scene::largest_stored(voxel);
}

cl::Memory upload(const Session& session, const scene::VoxelGrid& grid,
                  technique::Sampler sampler) {
  return checked([&]() -> cl::Memory {
    if (sampler == technique::Sampler::manual) return upload_buffer(session, grid);
    return upload_image(session, grid);
  });
}

const VolumeCache::Entry& VolumeCache::get(const Session& session, const scene::VoxelGrid& grid,
                                           technique::Sampler sampler,
                                           const technique::BrickLayout& layout, int stored_cells) {
  const std::string key = grid.hash.empty()
                              ? std::string()
                              : fmt::format("{} {} {} {}", grid.hash, scene::name_of(grid.format),
                                            technique::name_of(sampler), stored_cells);
  if (!key.empty() && key == key_) {
    if (layout != entry_.layout) {
      entry_.ranges = technique::brick_ranges(grid, layout);
      entry_.layout = layout;
    }
    return entry_;
  }
  key_.clear();
  entry_ = {};  // frees the old volume before the new one is allocated
  const auto allocate = [&] {
    return checked([&]() -> cl::Memory {
      return make_buffer(session, CL_MEM_READ_ONLY, bordered_layers(grid).bytes_of(stored_cells));
    });
  };
  entry_ = {.volume = stored_cells > 0 ? allocate() : upload(session, grid, sampler),
            .layout = layout,
            .ranges = technique::brick_ranges(grid, layout)};
  key_ = key;
  return entry_;
}

}  // namespace triptych::opencl_backend
