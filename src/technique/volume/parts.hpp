#pragma once
// A volume of which a device holds one part at a time: slabs across z, drawn one after the other
// from the eye outwards, so that each ray meets them front to back. Rays, samples and bricks are
// the whole volume's; only a fetch counts its layers from where the part begins. So the bits are
// the whole's.

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

// Along z, in cells numbered as in packed_cells.hpp: cell c lies between slices c − 1 and c,
// clamped to the edge, and there is one more of them than slices.
struct Part {
  int begin = 0;  // a pass takes the samples that lie in these cells
  int end = 0;
  int first_held = 0;  // of the cells that the device holds: what these samples reach
  int end_held = 0;

  [[nodiscard]] int held() const noexcept { return end_held - first_held; }
  bool operator==(const Part&) const = default;
};

// How a backend holds cells: as layers of so many bytes, of which there are `more` than cells in a
// part, at most; and what all of the volume takes.
struct Layers {
  std::uint64_t bytes = 0;
  int more = 0;
  std::uint64_t whole = 0;

  [[nodiscard]] std::uint64_t bytes_of(int cells) const {
    return bytes * static_cast<std::uint64_t>(cells + more);
  }
  // Of the part that holds most, or of the whole where there are none.
  [[nodiscard]] std::uint64_t room_for(std::span<const Part> parts) const;
};
// Of plain slices.
[[nodiscard]] Layers slice_layers(const std::array<int, 3>& size, scene::VoxelFormat format);
// Of Sampler::packed.
[[nodiscard]] Layers packed_layers(const std::array<int, 3>& size, scene::VoxelFormat format);
// Of a device that holds all others as slices of an image.
[[nodiscard]] Layers layers_of(const scene::VolumeScene& scene, const RaycastOptions& options);

// What the voxels of a device may take: its own limit, by its name, or less by the options' budget.
struct Room {
  std::uint64_t bytes = 0;
  std::string limit;
};
[[nodiscard]] Room within_budget(Room room, const RaycastOptions& options);

struct Cut {
  std::vector<Part> parts;            // in the order of their passes; none where the whole has room
  std::optional<std::string> reason;  // why it can be drawn neither whole nor in parts
};
// Beyond the cells of its samples a part holds one for rounding, of what is shaded one for
// gradients, and as many as a preintegrated step may be long. The first one takes the samples of
// one cell more on either side: rounding may put a ray's first sample behind the eye.
[[nodiscard]] Cut cut_into_parts(std::string_view technique, const scene::VolumeScene& scene,
                                 const RaycastOptions& options, const Layers& layers,
                                 const Room& room);

// Cells of the part that holds most.
[[nodiscard]] int most_held(std::span<const Part> parts);

// The slices that the cells it holds lie between; the first is that of cell first_held − 1, or of
// 0.
struct Slices {
  std::span<const std::byte> bytes;
  int count = 0;
};
[[nodiscard]] Slices slices_of(const Part& part, const scene::VoxelGrid& grid);

// Behind the parameters (raycast_parameters) of kernels that draw parts.
struct PartParameters {
  std::int32_t begin, end, first_held, held;  // of the Part
  std::int32_t pass;                          // counted from 0
  std::int32_t padding[3];
};

// One of a frame's.
struct PartPass {
  Part part;
  PartParameters parameters;
  // Whether any brick near the part is visible; else leaps pass over its voxels, which need not be
  // there.
  bool read = true;
};
// `map`: brick_map of scene and options.
[[nodiscard]] std::vector<PartPass> part_passes(std::span<const Part> parts,
                                                const scene::VolumeScene& scene,
                                                const RaycastOptions& options,
                                                std::span<const std::int32_t> map);
// Of voxels that have to be there, over all passes.
[[nodiscard]] std::uint64_t moved_bytes(std::span<const PartPass> passes, const Layers& layers);

// What a kernel leaves of a ray between two passes takes at most so many bytes.
inline constexpr std::size_t pause_bytes = 256;

}  // namespace triptych::technique
