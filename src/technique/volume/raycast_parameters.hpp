#pragma once
// How a volume may be raycast, and what the kernels of every API are given.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/volume_scene.hpp"

namespace triptych::technique {

// Who interpolates between voxels: the device's sampler; the kernel, from eight of them; the
// kernel, from a cell that holds all eight (packed_cells.hpp).
enum class Sampler : std::uint8_t { hardware, manual, packed };
// What empty space is skipped by: nothing; a walk from brick to brick; leaps over whole cubes of
// bricks of one kind, as far as the next brick of the other kind allows (brick_reach.hpp).
enum class Skip : std::uint8_t { none, bricks, distance };
// What everything between the parameters and the picture is computed in: rays, positions,
// interpolation, colours, opacities, compositing. Voxels, the transfer function's entries and the
// picture are floats with either.
enum class Precision : std::uint8_t { fp32, fp64 };
[[nodiscard]] std::string_view name_of(Sampler sampler);
[[nodiscard]] std::string_view name_of(Skip skip);
[[nodiscard]] std::string_view name_of(Precision precision);
[[nodiscard]] Sampler sampler(std::string_view name);      // throws InputError
[[nodiscard]] Skip skip(std::string_view name);            // throws InputError
[[nodiscard]] Precision precision(std::string_view name);  // throws InputError

// Faults that can be injected to prove that the gate catches them. Kernels take the number as a
// compile-time constant, so that an unchanged kernel holds no trace of them.
enum class Fault : std::uint8_t {
  none = 0,
  half_voxel_shift = 1,     // the volume is read half a voxel off along x
  flipped_axis = 2,         // y is read mirrored
  extra_sample = 3,         // one whole sample too many at the end of each ray
  uncorrected_opacity = 4,  // opacity is taken per sample, not per voxel length
  coarse_filter = 5         // interpolation weights are rounded to 8 bits
};

// The choices that change the picture by no more than its bound.
struct RaycastOptions {
  Sampler sampler = Sampler::manual;
  Skip skip = Skip::distance;
  double ert = 1.0 / 512;  // stop below this transmittance; 0: never
  double adapt = 0;        // error that merging samples within bricks may make (brick_kinds.hpp)
  Precision precision = Precision::fp32;
  // Bytes of device memory for voxels: a volume that takes more is drawn in parts (parts.hpp); 0:
  // as many as the device's own limits let it have.
  std::uint64_t budget = 0;
  Fault fault = Fault::none;
  // 1/extra_work_stride of the image is drawn a second time (volume/extra_work.hpp): an injected
  // slowdown of as much by real work; 0: none.
  int extra_work_stride = 0;
};

// Why the technique cannot draw this scene with these options on any device; empty where it can.
[[nodiscard]] std::optional<std::string> raycast_reason(std::string_view technique,
                                                        const scene::VolumeScene& scene,
                                                        const RaycastOptions& options);

// Mirrors parameters.glsl (std140) and parameters.cl: numbers in groups of four only. Real is float
// or, for Precision::fp64, double. Lengths along a ray are counted in steps, positions in voxels
// (voxel centres at i+½).
template <class Real>
struct BasicRaycastParameters {
  using Four = std::array<Real, 4>;
  Four eye;              // xyz: eye/spacing; w: h, the step in world units
  Four ray_centre;       // xyz: forward, world; w: h / smallest spacing, the step in voxels
  Four ray_right;        // xyz: right · aspect · tan(fov/2); w: ERT ε
  Four ray_up;           // xyz: up · tan(fov/2); w: gradient floor
  Four inverse_spacing;  // xyz: 1/spacing; w: smallest spacing
  // x, y: normalised = stored·x + y; z: ray_plane; w: with doubles, what a texel is to be
  // multiplied by to be the integer that is stored, and 0 where it is that already; else 0
  Four value_map;
  Four shading;                             // ambient, diffuse, specular; w: parts of a cell
  Four background;                          // premultiplied RGBA
  std::array<std::int32_t, 4> volume_size;  // voxels; w: log2 of the specular exponent
  std::array<std::int32_t, 4>
      brick_grid;  // bricks per axis; w: brick edge in voxels, 0: no skipping
  // width, height; stride and again of tri_drawn_column
  std::array<std::int32_t, 4> viewport;
};
using RaycastParameters = BasicRaycastParameters<float>;
static_assert(sizeof(RaycastParameters) == std::size_t{11} * 16);
static_assert(offsetof(RaycastParameters, volume_size) == std::size_t{8} * 16);
static_assert(sizeof(BasicRaycastParameters<double>) == std::size_t{8} * 32 + std::size_t{3} * 16);
static_assert(offsetof(BasicRaycastParameters<double>, volume_size) == std::size_t{8} * 32);

// Distance from the eye along the view axis, in world units, of the plane on which rays begin: the
// box's nearest corner, where that is far away. Float coordinates of a far eye would be off by
// voxels; those of a point on the plane are as exact as the box's own. 0: they begin at the eye.
[[nodiscard]] double ray_plane(const scene::VolumeScene& scene);
// Of the box: nearer, an eye costs less than 1e-4 of its size.
inline constexpr double far_in_diagonals = 16;

// The bytes of the parameters in the options' precision. The stored integer of a u8 or u16 grid
// arrives in a shader as itself (buffer) or over its maximum (UNORM texture): `stored_maximum` is 1
// or 255 or 65535 accordingly.
[[nodiscard]] std::vector<std::byte> raycast_parameters(const scene::VolumeScene& scene,
                                                        const RaycastOptions& options,
                                                        double stored_maximum);

// The counters a counting kernel leaves per pixel, in this order.
inline constexpr std::array<std::string_view, 7> raycast_counters{
    "rays_hit",       "samples",         "samples_nonzero", "bricks_visited",
    "bricks_skipped", "rays_terminated", "samples_saved"};
// Unsigned 32-bit integers per pixel in the counters' buffer; the eighth is padding.
inline constexpr std::size_t raycast_counter_stride = 8;

}  // namespace triptych::technique
