#pragma once
// A volume on the device, in the layout that the sampler needs, and its bricks.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "backends/opencl/objects.hpp"
#include "scene/volume.hpp"
#include "technique/volume/bricks.hpp"
#include "technique/volume/parts.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::opencl_backend {

// The format of a 3D image with one channel for these voxels: CL_R, otherwise CL_INTENSITY or
// CL_LUMINANCE, otherwise CL_RGBA; nullopt if the device has none of them.
[[nodiscard]] std::optional<cl::ImageFormat> image_format(const Session& session,
                                                          scene::VoxelFormat voxel);

// The buffer that the manual sampler reads: the volume with a border on every side that repeats its
// outermost layer. Cell c is between slices c and c + 1 of it.
[[nodiscard]] technique::Layers bordered_layers(const scene::VoxelGrid& grid);
// Fills the beginning of such a buffer with this many cells, beginning with `first`. Throws
// cl::Error.
void write_layers(const Session& session, const cl::Buffer& buffer, const scene::VoxelGrid& grid,
                  int first, int cells);

// The stored number that the kernel sees as 1 (technique::raycast_parameters).
[[nodiscard]] double stored_maximum(scene::VoxelFormat voxel, technique::Sampler sampler);

// The bytes that upload() writes to the device.
[[nodiscard]] std::vector<std::byte> uploaded_voxels(const Session& session,
                                                     const scene::VoxelGrid& grid,
                                                     technique::Sampler sampler);
// A cl::Buffer for Sampler::manual, a cl::Image3D for Sampler::hardware. The upload has finished
// when this returns.
[[nodiscard]] cl::Memory upload(const Session& session, const scene::VoxelGrid& grid,
                                technique::Sampler sampler);

// The volume that was drawn last, because neighbouring configurations of a plan share it.
class VolumeCache {
 public:
  struct Entry {
    cl::Memory volume;
    technique::BrickLayout layout;
    technique::BrickRanges ranges;
  };
  // Valid until the next call. With `held_cells`, it is a buffer for that many cells with undefined
  // content.
  [[nodiscard]] const Entry& get(const Session& session, const scene::VoxelGrid& grid,
                                 technique::Sampler sampler, const technique::BrickLayout& layout,
                                 int held_cells);

 private:
  std::string key_;
  Entry entry_;
};

}  // namespace triptych::opencl_backend
