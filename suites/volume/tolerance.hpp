#pragma once
// The largest difference from the reference image that a correct image may have. It is derived from
// the arithmetic of a device. No number here was chosen by looking at an image.

#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::volume_suite {

// The properties of a path through the device that decide its precision.
struct PathPrecision {
  double ert = 0;                  // ε: a ray may end when less light than this is left
  double adapt = 0;                // allowed error of merged samples (technique::brick_kinds)
  // Error of the device's sampler, found by a probe (measure::Device).
  double filter_weight_error = 0;
  double storage_step = 0;         // normalised value per step of a voxel format that loses values
  double voxel_rounding = 0;       // relative error of each voxel, for a format that rounds
  technique::Precision precision = technique::Precision::fp32;
};

// The error model counts roundings. u = 2⁻²⁴ is the unit roundoff of float. Every basic operation
// has a relative error of at most u; a division has 2.5 ulp = 5u where the API allows it.
//
// Position, in voxels per axis.
//   e    the eye, in the box's coordinates divided by the smallest spacing
//   D    distance from the eye to the farthest corner of the box
//   T    distance from the eye to the farthest corner of the faces that it sees, through which
//        rays enter; 0 if the eye is inside
//   L    the diagonal of the box
// All lengths are in the smallest spacing, because the error of a direction is relative to its
// whole length, whatever the spacing along the axis that it moves a sample on.
//   - Rounding eye/spacing once: u·|e|.
//   - Direction: a sum of three products has at most 6u of its length, including the 4 operations
//     of the normalised device coordinates. Normalising it adds 3u for the dot product, 5u/2 for
//     the square root and 5u for the division; scaling by 1/spacing adds 2u. Together below 20u of
//     its length. So a device's ray is a straight line within u·(|e| + 20·D) of the exact one, as
//     far as it is inside the box. Such a ray also enters the box earlier or later, which moves all
//     its samples along the ray. The reference accounts for that (reference/ray.hpp), so it is not
//     counted here a second time.
//   - Along the ray: the entry t₀ = (face − e)/v is a subtraction and a division, 6u·t₀. In
//     e + t₀·v the product adds u·t₀|v| and the sum u·L. A sample adds (i+½)·g with g = v·h, 3u of
//     the way inside, and u·L for the sum: 7u·T + 5u·L for a sample.
//   - Length of the chord: (t₁ − t₀)/h has an error of 6u·(t₁ + t₀)|v| + 7u·L. The reference moves
//     both ends by the position error, so half of it is needed here. With t₁|v| ≤ D ≤ T + L this is
//     6u·T + 6½u·L.
//   - The larger of the two covers both:
//         u·(|e| + 20·D + 7·T + 7·L)
//   - If the eye is far away, rays begin on a plane at the distance s (technique::ray_plane). Then
//     e, D and T belong to the plane's point on the view axis, which is computed in double
//     precision. The point of a single ray adds its normalised device coordinates, which are
//     rounded by 3u, times the half diagonal E of the image on the plane, and six more operations
//     on a length ≤ D:
//         u·(4·E + 6·D)
//
// Value, normalised.
//   - Three nested interpolations a + f·(b − a) have 3u each of the largest stored value.
//   - stored·scale + offset adds 2u: 11u·M, with M = |scale|·stored_max + |offset|.
//   - The table position 256·x − ½ adds u twice: 13u·M.
//   - Half a storage step is added if the voxel format loses values.
//   - Quadrature cells makes a cubic of the eight voxels. Its terms are products of at most four
//     factors that are added up, 6u each, and together at most 14 times the range R of the format:
//     84u·R more.
//
// Voxels as half floats (scene::VoxelGrid). Integers for which fits_halves is true are exact.
// Otherwise 2¹⁵·x is rounded to 11 bits, by 2⁻¹¹/(1 + 2⁻¹¹) of x. The reference's float may differ
// from x by u·x, which is less than the remainder of 2⁻¹¹·x. A value below 2⁻²⁹ would be subnormal
// and becomes 0: half a storage step of 2⁻²⁸. Nothing overflows, because 2¹⁵ < 65504.
//
// Filter. The probed error of the weights, rounded up to a power of two, and at least u. A sampler
// that rounds its result to the steps of the format has that error even between equal voxels. The
// probe's neighbours differ by the whole range, so it sees both errors together, and its result is
// also an absolute error of the value.
//
// Table. Interpolation between two entries: 3u. Preintegrated: 4u, because the opacity in the
// middle of a cell's part is rounded once more.
//
// Opacity, relative.
//   - tri_opacity is accurate to 8u, the two factors of its exponent have 2u each, and the share of
//     the step has 2u: 14u.
//   - Preintegrated: the mean of the logarithm has 8u and its series 3u. The length of a piece has
//     2u for the share, 4u for the division by the difference of two positions and 2u for the
//     product. The exponential has 8u. Combining three pieces adds u each for a product and a sum:
//     32u.
//   - Cells: two logarithms 9u, their sum and three products of lengths 5u, the exponential 3u, and
//     the same again for the lengths, whose differences cancel from piece to piece: below 32u.
//
// Adapt. technique/volume/brick_kinds.hpp derives the error between two images of one device, with
// and without merged bricks. All other terms are about the image without. The arithmetic of a
// merged sample is covered by them, because the exponent of its opacity has the same two factors,
// and because it replaces many samples.
//
// Compositing, relative per sample. Weight u, product u, sum u, transmittance u: 4u.
//
// Precision fp64. The counts are the same with u = 2⁻⁵², because the kernels have the same text.
// That is twice the unit roundoff of double, because the reference is also computed in doubles and
// may have the same error as the device. There are three differences:
//   - The parameters are doubles and the eye is not rounded, which the count above includes.
//   - tri_opacity is accurate to 12u: 12u + 4u + 2u = 18u.
//   - Output: a channel is rounded to float when it is stored, and so is the reference image, which
//     adds 2·2⁻²⁴ of the channel. In fp32 compositing has already rounded it.
[[nodiscard]] reference::ErrorModel error_model(const scene::VolumeScene& scene,
                                                const PathPrecision& path);

}  // namespace triptych::volume_suite
