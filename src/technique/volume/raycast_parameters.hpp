#pragma once
// The options for volume raycasting, and the parameters of the kernels on every API.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/volume_scene.hpp"

namespace triptych::technique {

// How voxels are interpolated: by the hardware sampler, or by the kernel. For `manual`, the kernel
// loads eight voxels one by one; for `packed`, it loads one cell that contains all eight voxels
// (packed_cells.hpp).
enum class Sampler : std::uint8_t { hardware, manual, packed };
// How empty space is skipped: not at all, by a walk from brick to brick, or (`distance`) by leaps
// over whole cubes of bricks that are all visible or all invisible (brick_reach.hpp).
enum class Skip : std::uint8_t { none, bricks, distance };
// The precision of all values between the parameters and the image: rays, positions, interpolation,
// colours, opacities and compositing. Voxels, the entries of the transfer function and the image
// are floats in both cases.
enum class Precision : std::uint8_t { fp32, fp64 };
[[nodiscard]] std::string_view name_of(Sampler sampler);
[[nodiscard]] std::string_view name_of(Skip skip);
[[nodiscard]] std::string_view name_of(Precision precision);
[[nodiscard]] Sampler sampler(std::string_view name);      // throws InputError
[[nodiscard]] Skip skip(std::string_view name);            // throws InputError
[[nodiscard]] Precision precision(std::string_view name);  // throws InputError

// Faults that can be injected to prove that the gate (Triptych's regression check) finds them. They
// are compile-time constants of kernels, so a kernel without a fault contains no code for them.
enum class Fault : std::uint8_t {
  none = 0,
  half_voxel_shift = 1,     // the volume is read half a voxel too far along x
  flipped_axis = 2,         // y is mirrored
  extra_sample = 3,         // one additional whole sample at the end of each ray
  uncorrected_opacity = 4,  // opacity is applied per sample instead of per voxel length
  coarse_filter = 5         // interpolation weights are rounded to 8 bits
};

// Options for how a volume is drawn. Except for injected faults, they change the image by no more
// than its bound, which is the largest permitted difference from the reference image.
struct RaycastOptions {
  Sampler sampler = Sampler::manual;
  Skip skip = Skip::distance;
  double ert = 1.0 / 512;  // early ray termination below this transmittance; 0: never
  double adapt = 0;        // allowed error due to merging samples within bricks (brick_kinds.hpp)
  Precision precision = Precision::fp32;
  // The number of bytes of device memory for voxels. A larger volume is drawn in parts (parts.hpp).
  // If the budget is 0, only the device's limits apply.
  std::uint64_t budget = 0;
  Fault fault = Fault::none;
  // A share 1/extra_work_stride of the image is drawn a second time (volume/extra_work.hpp). This
  // injects a slowdown of about this share through real work. 0 disables it.
  int extra_work_stride = 0;
};

// Returns why the technique cannot draw this scene with these options on any device, or nullopt if
// it can.
[[nodiscard]] std::optional<std::string> raycast_reason(std::string_view technique,
                                                        const scene::VolumeScene& scene,
                                                        const RaycastOptions& options);

// The layout is the same as in parameters.glsl (std140) and parameters.cl, and all members are
// groups of four numbers. Real is float, or double for Precision::fp64. Lengths along a ray are in
// steps, and positions are in voxels (voxel centres are at i+½).
template <class Real>
struct BasicRaycastParameters {
  using Four = std::array<Real, 4>;
  Four eye;              // xyz: eye/spacing; w: h, the step in world units
  Four ray_centre;       // xyz: forward, world; w: h / smallest spacing, the step in voxels
  Four ray_right;        // xyz: right · aspect · tan(fov/2); w: RaycastOptions::ert
  Four ray_up;           // xyz: up · tan(fov/2); w: Shading::gradient_floor
  Four inverse_spacing;  // xyz: 1/spacing; w: smallest spacing
  // The normalised value is stored·x + y. z is ray_plane. w is needed only with doubles: the factor
  // that converts a texel to the stored integer, or 0 if the texel already is that integer.
  Four value_map;
  Four shading;                             // ambient, diffuse, specular; w: scene.parts_of_cell()
  Four background;                          // premultiplied RGBA
  std::array<std::int32_t, 4> volume_size;  // xyz: size in voxels; w: log2 of the specular exponent
  // Bricks per axis. w is the edge of a brick in voxels; 0 means no skipping.
  std::array<std::int32_t, 4> brick_grid;
  // Width and height, and the arguments `stride` and `again` of tri_drawn_column.
  std::array<std::int32_t, 4> viewport;
};
using RaycastParameters = BasicRaycastParameters<float>;
static_assert(sizeof(RaycastParameters) == std::size_t{11} * 16);
static_assert(offsetof(RaycastParameters, volume_size) == std::size_t{8} * 16);
static_assert(sizeof(BasicRaycastParameters<double>) == std::size_t{8} * 32 + std::size_t{3} * 16);
static_assert(offsetof(BasicRaycastParameters<double>, volume_size) == std::size_t{8} * 32);

// Returns the distance from the eye, along the view axis and in world units, of the plane on which
// rays begin, or 0 if rays begin at the eye. If the eye is far away, the plane passes through the
// box's nearest corner. The reason is that float coordinates of a distant eye would have errors of
// whole voxels, while a point on the plane is as accurate as the box itself.
[[nodiscard]] double ray_plane(const scene::VolumeScene& scene);
// If the distance of the eye exceeds this number of diagonals of the box, rays begin on the plane
// that ray_plane() returns. For a closer eye, the error of positions is less than 1e-4 of the box's
// size.
inline constexpr double far_eye_in_diagonals = 16;

// Returns the bytes of the parameters, in the precision of the options. A u8 or u16 voxel reaches
// the shader either as its stored integer (buffer) or divided by the largest integer (UNORM
// texture). `stored_maximum` is 1 in the first case, and 255 or 65535 in the second case.
[[nodiscard]] std::vector<std::byte> raycast_parameters(const scene::VolumeScene& scene,
                                                        const RaycastOptions& options,
                                                        double stored_maximum);

// The counters that a kernel with counters writes for each pixel, in this order.
inline constexpr std::array<std::string_view, 7> raycast_counters{
    "rays_hit",       "samples",         "samples_nonzero", "bricks_visited",
    "bricks_skipped", "rays_terminated", "samples_saved"};
// The number of unsigned 32-bit integers per pixel in the counter buffer. The eighth integer is
// padding, except when a ray's history is recorded (ray_trace.hpp).
inline constexpr std::size_t raycast_counter_stride = 8;

}  // namespace triptych::technique
