#pragma once
// Draws a volume that does not fit into device memory. The volume is divided into parts, of which
// the device stores only one at a time. The parts are slabs along z. They are drawn one after the
// other, outwards from the eye, so that each ray passes through them from front to back. Rays,
// samples and bricks are the same as for the whole volume; only the layer indices in fetches are
// relative to the part. The image is therefore bit-identical to that of the whole volume.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/volume_scene.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::technique {

// A range of cells along z, numbered as in packed_cells.hpp: cell c is between the slices c − 1 and
// c, clamped to the edge. There is one more cell than there are slices.
struct Part {
  int begin = 0;  // the pass takes the samples in the cells from `begin` to `end` (exclusive)
  int end = 0;
  int first_stored = 0;  // the cells that the device stores, because these samples may read them
  int end_stored = 0;

  [[nodiscard]] int stored_cells() const noexcept { return end_stored - first_stored; }
  bool operator==(const Part&) const = default;
};

// Describes how a backend stores cells: in layers of `bytes` bytes each. A part with n cells needs
// n + `more` layers. `whole` is the size of the whole volume in bytes.
struct Layers {
  std::uint64_t bytes = 0;
  int more = 0;
  std::uint64_t whole = 0;

  [[nodiscard]] std::uint64_t bytes_of(int cells) const {
    return bytes * static_cast<std::uint64_t>(cells + more);
  }
  // Returns the size of the largest part in bytes, or of the whole volume if there are no parts.
  [[nodiscard]] std::uint64_t largest_part_bytes(std::span<const Part> parts) const;
};
// Returns the layers for plain slices.
[[nodiscard]] Layers slice_layers(const std::array<int, 3>& size, scene::VoxelFormat format);
// Returns the layers for Sampler::packed.
[[nodiscard]] Layers packed_layers(const std::array<int, 3>& size, scene::VoxelFormat format);
// Returns packed_layers for Sampler::packed, and slice_layers for every other sampler.
[[nodiscard]] Layers layers_of(const scene::VolumeScene& scene, const RaycastOptions& options);

// The maximum number of bytes of device memory for voxels, and the name of this limit, which is the
// device's own limit or, if it is lower, the budget in the options.
struct MemoryLimit {
  std::uint64_t bytes = 0;
  std::string name;
};
[[nodiscard]] MemoryLimit within_budget(MemoryLimit limit, const RaycastOptions& options);

struct Cut {
  std::vector<Part> parts;  // in the order of their passes; empty if the whole volume fits
  // The reason why the volume can be drawn neither as a whole nor in parts, if there is one.
  std::optional<std::string> reason;
};
// Cuts the volume into parts that fit. The first part also takes the samples in one more cell on
// each side, because rounding may put a ray's first sample behind the eye. On each side, every part
// contains additional cells that its samples may read: one for the additional cell of the first
// part, one for rounding, one for gradients if shading is enabled, and as many as a preintegrated
// step may cross.
[[nodiscard]] Cut cut_into_parts(std::string_view technique, const scene::VolumeScene& scene,
                                 const RaycastOptions& options, const Layers& layers,
                                 const MemoryLimit& limit);

// Returns the number of cells in the largest part.
[[nodiscard]] int most_stored_cells(std::span<const Part> parts);

// The slices that the cells of a part need. The first slice is slice first_stored − 1, or slice 0
// if that is negative.
struct Slices {
  std::span<const std::byte> bytes;
  int count = 0;
};
[[nodiscard]] Slices slices_of(const Part& part, const scene::VoxelGrid& grid);

// The parameters of kernels that draw parts. They are stored directly after the raycast_parameters.
struct PartParameters {
  std::int32_t begin, end, first_stored, stored_cells;  // see Part
  std::int32_t pass;                                    // 0-based index
  std::int32_t padding[3];
};

// One pass of a frame.
struct PartPass {
  Part part;
  PartParameters parameters;
  // Whether any brick near the part is visible. If not, the leaps of Skip::distance skip all voxels
  // of the part, so these voxels need not be on the device.
  bool read = true;
};
// Returns the passes in order. `map` is the brick_map for this scene and these options.
[[nodiscard]] std::vector<PartPass> part_passes(std::span<const Part> parts,
                                                const scene::VolumeScene& scene,
                                                const RaycastOptions& options,
                                                std::span<const std::int32_t> map);
// Returns the total number of bytes of voxels that must be uploaded in all passes.
[[nodiscard]] std::uint64_t moved_bytes(std::span<const PartPass> passes, const Layers& layers);

// The maximum size in bytes of the state that a kernel stores for a ray between two passes.
inline constexpr std::size_t pause_bytes = 256;

}  // namespace triptych::technique
