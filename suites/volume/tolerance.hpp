#pragma once
// How far a right picture may be from the truth, derived from what the arithmetic of a device may
// do. No number here was chosen by looking at an image.

#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::volume_suite {

// What of a path decides its precision.
struct PathPrecision {
  double ert = 0;                  // ε at which rays may end
  double adapt = 0;                // what merged samples may cost (technique::brick_kinds)
  double filter_weight_error = 0;  // of the device's sampler, as probed (measure::Device)
  double storage_step = 0;    // normalised value per step of a voxel format too small for the data
  double voxel_rounding = 0;  // of one that rounds each voxel by a share of it
  technique::Precision precision = technique::Precision::fp32;
};

// u = 2⁻²⁴, the unit roundoff of float; every basic operation errs by at most u relative
// (division 2.5 ulp = 5u where an API allows it). The count for each term:
//
// position, voxels per axis. eye/spacing is rounded once: u·|e|. The direction is a sum of three
// products
//   (≤ 6u of its length with ndc's 4 operations) and is normalised (dot 3u, square root ≤ 5u
//   halved, division 5u), then scaled by 1/spacing (2u): ≤ 20u of its length. So a device's ray is
//   a straight line that lies within u·(|e| + 20·D) of the true one as far as it is in the box.
//   That it enters earlier or later for that, and moves all its samples along itself, is the
//   reference's part (reference/ray.hpp); counted once more here it would be there twice. Along its
//   own line: the entry t₀ = (face − e)/v is a subtraction and a division, 6u·t₀; in e + t₀·v the
//   product adds u·t₀|v|, the sum u·L. A sample adds (i+½)·g, g = v·h: 3u of the way inside, and
//   u·L for the sum. The length of the chord, (t₁ − t₀)/h, errs by 6u·(t₁ + t₀)|v| and 7u·L; the
//   reference moves either end by what stands here, so half of it is asked for.
//   With D the distance of the eye to the farthest corner of the box, T that to the farthest corner
//   of the faces that it sees, where rays enter (0 from within), L the box's diagonal, all in the
//   smallest spacing, as the error of a direction is one of its whole length, whatever the spacing
//   along the axis that it moves a sample on:
//       u·(|e| + 20·D + 7·T + 7·L)
//   (a sample: 7·T and 5·L; a chord's half, as t₁|v| ≤ D ≤ T + L: 6·T and 6½·L.)
//   Of a far eye rays begin on a plane at the distance s (technique::ray_plane): e, D and T are
//   then those of the plane's point on the view axis, found in double precision. A ray's own point
//   adds ndc, which rounds by 3u whatever it is, times the picture's half diagonal E on the plane,
//   and six more operations on a length ≤ D: u·(4·E + 6·D).
// value, normalised. Three nested interpolations a + f·(b − a), 3u each of the largest stored
// value, then
//   stored·scale + offset, 2u: 11u·M, M = |scale|·stored_max + |offset|; a u of the table position
//   256·x − ½ twice more: 13u·M. Half a storage step where the voxel format loses values. Cells
//   make a cubic of the eight voxels: its terms are products of at most four factors, summed in
//   turn, 6u each, and together at most 14 times the range R of the format: 84u·R more.
// voxels. Halves (scene::VoxelGrid): integers that fits_halves says are exact are off by nothing.
//   Else 2¹⁵·x is rounded to 11 bits: by 2⁻¹¹/(1 + 2⁻¹¹) of x, and a u of x in which the truth's
//   float may differ from x is less than the rest of 2⁻¹¹·x. What would be subnormal, below 2⁻²⁹ of
//   x, is 0: half a storage step of 2⁻²⁸. Nothing overflows, as 2¹⁵ < 65504.
// filter. The probed error of the weights, rounded up to a power of two; never less than u. A
// sampler
//   that rounds its result to the steps of the format errs by that much between equal voxels too;
//   the probe, whose neighbours differ by the whole range, sees both errors together, so what it
//   found is an absolute error of the value as well.
// table. Interpolation between two entries: 3u. Preintegrated: 4u, for the opacity in the middle of
//   a cell's part is rounded once more.
// opacity, relative. tri_opacity is stated to 8u, its exponent's two factors 2u each, the share of
// the
//   step 2u: 14u. Preintegrated: the logarithm's mean (8u and 3u of its series), a piece's length
//   (share 2u, division by the difference of two positions 4u, product 2u), the exponential 8u, and
//   three pieces put together, 1u each for product and sum: 32u. Cells: two logarithms, 9u, their
//   sum and three products of lengths 5u, the exponential 3u, and as much again for the lengths
//   themselves, whose differences cancel from piece to piece: below the same 32u.
// adapt. Itself: technique/volume/brick_kinds.hpp derives it between two pictures of one device,
// and
//   the one without is what all other terms are about. A merged sample's own arithmetic is theirs:
//   the exponent of its opacity has the same two factors, and its number is one of many.
// compositing, relative per sample. weight u, product u, sum u, transmittance u: 4u.
//
// Precision fp64: the same counts, as the kernels are the same text, with u = 2⁻⁵². That is twice
// the unit roundoff of double, for the truth is computed in doubles as well and may err by as much
// as the device. Three things differ.
//   The parameters come in doubles and the eye is not rounded, which the count above includes.
//   opacity. tri_opacity is stated to 12u: 12u + 4u + 2u = 18u.
//   output. A channel is rounded to float when it is stored, and so is the truth's picture: 2·2⁻²⁴
//   of the channel. In fp32 compositing has rounded it already.
[[nodiscard]] reference::ErrorModel error_model(const scene::VolumeScene& scene,
                                                const PathPrecision& path);

}  // namespace triptych::volume_suite
