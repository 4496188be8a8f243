#pragma once
// A volume and its bricks on the device, in the layout that the sampler requires.

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

// Returns the format of a single-channel 3D image for these voxels. Prefers CL_R, then
// CL_INTENSITY, CL_LUMINANCE and CL_RGBA. Returns nullopt if the device supports none of them.
[[nodiscard]] std::optional<cl::ImageFormat> image_format(const Session& session,
                                                          scene::VoxelFormat voxel);

// Returns the memory layout of the buffer that the manual sampler reads. The buffer contains the
// volume with a border on every side that repeats the outermost voxels. The layout is divided into
// cells along z: cell c lies between the slices c and c + 1 of the buffer.
[[nodiscard]] technique::Layers bordered_layers(const scene::VoxelGrid& grid);
// Writes the slices of `cells` such cells, beginning with cell `first` of the volume, to the
// beginning of a buffer with the layout of bordered_layers(). Throws cl::Error.
void write_layers(const Session& session, const cl::Buffer& buffer, const scene::VoxelGrid& grid,
                  int first, int cells);

// Returns the stored number that the kernel reads as 1 (technique::raycast_parameters).
[[nodiscard]] double stored_maximum(scene::VoxelFormat voxel, technique::Sampler sampler);

// Returns the bytes that upload() writes to the device.
[[nodiscard]] std::vector<std::byte> uploaded_voxels(const Session& session,
                                                     const scene::VoxelGrid& grid,
                                                     technique::Sampler sampler);
// Uploads the volume, and returns a cl::Buffer for Sampler::manual or a cl::Image3D for
// Sampler::hardware. Returns when the upload has finished.
[[nodiscard]] cl::Memory upload(const Session& session, const scene::VoxelGrid& grid,
                                technique::Sampler sampler);

// Caches the most recently drawn volume, because consecutive configurations of a plan often draw
// the same volume.
class VolumeCache {
 public:
  struct Entry {
    cl::Memory volume;
    technique::BrickLayout layout;
    technique::BrickRanges ranges;
  };
  // The result is valid until the next call. If `stored_cells` is not 0, the volume is a buffer for
  // that many cells with undefined content.
  [[nodiscard]] const Entry& get(const Session& session, const scene::VoxelGrid& grid,
                                 technique::Sampler sampler, const technique::BrickLayout& layout,
                                 int stored_cells);

 private:
  std::string key_;
  Entry entry_;
};

}  // namespace triptych::opencl_backend
