#pragma once
// A volume of which a device stores one part at a time: slabs along z, drawn one after the other
// from the eye outwards, so that each ray meets them front to back. Rays, samples and bricks are
// those of the whole volume; only the fetches count layers from the beginning of the part. The
// image therefore has the same bits as that of the whole volume.

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

// A range along z of cells, numbered as in packed_cells.hpp: cell c lies between the slices c − 1
// and c, clamped to the edge, and there is one more cell than slices.
struct Part {
  int begin = 0;  // a pass takes the samples in these cells
  int end = 0;
  int first_held = 0;  // range of cells on the device, which the samples may read
  int end_held = 0;

  [[nodiscard]] int held() const noexcept { return end_held - first_held; }
  bool operator==(const Part&) const = default;
};

// How a backend stores cells: in layers with this many bytes each. A part has at most `more` layers
// more than cells. `whole` is the size of the whole volume.
struct Layers {
  std::uint64_t bytes = 0;
  int more = 0;
  std::uint64_t whole = 0;

  [[nodiscard]] std::uint64_t bytes_of(int cells) const {
    return bytes * static_cast<std::uint64_t>(cells + more);
  }
  // The bytes for the largest part, or for the whole volume if there are no parts.
  [[nodiscard]] std::uint64_t room_for(std::span<const Part> parts) const;
};
// Layers of plain slices.
[[nodiscard]] Layers slice_layers(const std::array<int, 3>& size, scene::VoxelFormat format);
// Layers of Sampler::packed.
[[nodiscard]] Layers packed_layers(const std::array<int, 3>& size, scene::VoxelFormat format);
// Layers of a device that stores everything except packed cells as slices of an image.
[[nodiscard]] Layers layers_of(const scene::VolumeScene& scene, const RaycastOptions& options);

// The memory that the voxels of a device may take: its own limit, with its name, or less because of
// the options' budget.
struct Room {
  std::uint64_t bytes = 0;
  std::string limit;
};
[[nodiscard]] Room within_budget(Room room, const RaycastOptions& options);

struct Cut {
  std::vector<Part> parts;  // in the order of their passes; empty if the whole volume fits
  // The reason why it can be drawn neither as a whole nor in parts.
  std::optional<std::string> reason;
};
// A part contains additional cells beyond those of its samples: one for rounding, with shading one
// for gradients, and as many as a preintegrated step may be long. The first part takes the samples
// of one more cell on either side, because rounding may put a ray's first sample behind the eye.
[[nodiscard]] Cut cut_into_parts(std::string_view technique, const scene::VolumeScene& scene,
                                 const RaycastOptions& options, const Layers& layers,
                                 const Room& room);

// The number of cells in the largest part.
[[nodiscard]] int most_held(std::span<const Part> parts);

// The slices between which its cells lie. The first is that of cell first_held − 1, or slice 0.
struct Slices {
  std::span<const std::byte> bytes;
  int count = 0;
};
[[nodiscard]] Slices slices_of(const Part& part, const scene::VoxelGrid& grid);

// Parameters of kernels that draw parts. They follow the raycast_parameters.
struct PartParameters {
  std::int32_t begin, end, first_held, held;  // see Part
  std::int32_t pass;                          // counted from 0
  std::int32_t padding[3];
};

// One pass of a frame.
struct PartPass {
  Part part;
  PartParameters parameters;
  // Whether any brick near the part is visible. Otherwise leaps skip all its voxels, which need not
  // be on the device.
  bool read = true;
};
// `map` is the brick_map of scene and options.
[[nodiscard]] std::vector<PartPass> part_passes(std::span<const Part> parts,
                                                const scene::VolumeScene& scene,
                                                const RaycastOptions& options,
                                                std::span<const std::int32_t> map);
// The bytes of voxels that must be uploaded, over all passes.
[[nodiscard]] std::uint64_t moved_bytes(std::span<const PartPass> passes, const Layers& layers);

// The largest number of bytes that a kernel keeps of a ray between two passes.
inline constexpr std::size_t pause_bytes = 256;

}  // namespace triptych::technique
