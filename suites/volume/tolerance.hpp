#pragma once
// Derives how much the image of a correct device may differ from the reference image. All numbers
// follow from counting the rounding errors of the device's arithmetic. None was tuned by looking at
// images.

#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::volume_suite {

// The properties of a rendering path on a device that determine its precision.
struct PathPrecision {
  double ert = 0;    // ε: transmittance below which a ray may end
  double adapt = 0;  // allowed error of merged samples (technique::brick_kinds)
  // The error of the device's sampler, measured by a probe (measure::Device).
  double filter_weight_error = 0;
  double storage_step = 0;    // resolution of a lossy voxel format, as a normalised value
  double voxel_rounding = 0;  // relative error of each voxel, for a format that rounds
  technique::Precision precision = technique::Precision::fp32;
};

// The error model counts roundings. u = 2⁻²⁴ is the unit roundoff of float. Every basic operation
// has a relative error of at most u. APIs allow division and square root to be less precise: 2.5
// ulp = 5u.
//
// 1. Position of a sample, in voxels per axis.
//   e    position of the eye, in voxels (eye/spacing)
//   D    distance from the eye to the farthest corner of the box
//   T    distance from the eye to the farthest corner of the faces that the eye sees, through which
//        rays enter; 0 if the eye is inside
//   L    diagonal of the box
//   v    direction of the ray, divided by the spacing
//   h    length of a step; g = v·h is one step in voxels
//   t₀   distance from the eye at which the ray enters the box; t₁ is where it leaves the box
// D, T and L are in units of the smallest spacing. The error of a direction is relative to its
// whole length, regardless of the spacing along the axis on which the error moves a sample.
//   - Eye: eye/spacing is rounded once, u·|e|.
//   - Direction: a sum of three products has an error of at most 6u of its length, including the 4
//     operations for the normalised device coordinates. Normalising it adds 3u for the dot product,
//     5u/2 for the square root and 5u for the division; scaling it by 1/spacing adds 2u. The total
//     is below 20u of its length. A device's ray is therefore a straight line that is within
//     u·(|e| + 20·D) of the exact line inside the box. Such a ray also enters the box earlier or
//     later, which moves all its samples along the ray. The reference renderer accounts for this
//     (reference/ray.hpp), so it is not counted here a second time.
//   - Distance along the ray: the entry t₀ = (face − e)/v is a subtraction and a division, 6u·t₀.
//     In e + t₀·v, the product adds u·t₀|v| and the sum u·L. A sample with the index i adds
//     (i+½)·g, which has an error of 3u of the distance inside the box, and another u·L for the
//     sum. The total is 7u·T + 5u·L.
//   - Length of the chord: (t₁ − t₀)/h has an error of 6u·(t₁ + t₀)|v| + 7u·L. The reference
//     renderer moves both ends of the chord by the position error, so half of this error is
//     sufficient here. With t₁|v| ≤ D ≤ T + L, it is 6u·T + 6½u·L.
//   - The larger coefficients of T and L cover both of the last two errors. The sum of all is
//         u·(|e| + 20·D + 7·T + 7·L)
//   - If the eye is far away, rays begin on a plane in front of the box (technique::ray_plane).
//     Then e, D and T are measured from the point of this plane on the view axis, which is computed
//     in double precision. The beginning of a single ray adds its normalised device coordinates
//     (3u) times half the diagonal E of the image on this plane, and six more operations on a
//     length of at most D:
//         u·(4·E + 6·D)
//
// 2. Value, normalised.
//   - Trilinear interpolation nests three interpolations a + f·(b − a). Each has an error of 3u of
//     the largest stored value.
//   - stored·scale + offset adds 2u. The sum is 11u·M, with M = |scale|·stored_max + |offset|.
//   - The position of the normalised value x in the table, 256·x − ½, adds u twice. The sum is
//     13u·M.
//   - If the voxel format loses precision, half a storage step is added.
//   - quadrature=cells computes a cubic from the eight voxels. Its terms are sums of products of at
//     most four factors. Each has an error of 6u, and together they are at most 14 times the range
//     R of the format, which adds 84u·R.
//
// 3. Voxels as half floats (scene::VoxelGrid). If fits_halves is true, integers are exact.
// Otherwise 2¹⁵·x is rounded to 11 bits, which changes x by at most 2⁻¹¹/(1 + 2⁻¹¹)·x. The model
// uses 2⁻¹¹·x. The remainder covers the reference renderer's float, which may differ from x by u·x.
// A value below 2⁻²⁹ would be subnormal and is replaced by 0. The error is less than 2⁻²⁹, so the
// model uses a storage step of 2⁻²⁸, half of which is added to the error of the value. Nothing
// overflows, because 2¹⁵ < 65504.
//
// 4. Filter. The error of the weights that the probe measured is rounded up to a power of two, and
// is at least u. A sampler that rounds its result to the steps of the format has this error even
// between equal voxels. The voxels of the probe differ by the whole range, so the probe measures
// both errors together. Its result is therefore also used as an absolute error of the value.
//
// 5. Table. Interpolation between two entries has an error of 3u. With quadrature=preintegrated, it
// is 4u, because the opacity in the middle of a piece between two entries is rounded once more.
//
// 6. Opacity, relative.
//   - Midpoint: tri_opacity (technique/portable/volume_math.h) converts the opacity of one voxel
//     length to that of the sample. It is accurate to 8u, the two factors of its exponent
//     contribute 2u each, and the share of a whole step that the sample covers contributes 2u. The
//     sum is 14u.
//   - Preintegrated: the mean of the logarithm contributes 8u, and its series 3u. The length of a
//     piece contributes 2u for the share, 4u for the division by the difference of two positions
//     and 2u for the product. The exponential contributes 8u. Combining three pieces adds u each
//     for a product and a sum. The total is at most 32u.
//   - Cells: two logarithms contribute 9u, their sum and three products of lengths 5u, and the
//     exponential 3u. The lengths contribute the same once more, because their differences cancel
//     from piece to piece. The total is below 32u.
//
// 7. Merged samples (factor `adapt`). technique/volume/brick_kinds.hpp derives the difference
// between two images from one device, with and without merging the samples of bricks. All other
// terms apply to the image without merging. They also cover the arithmetic of a merged sample,
// because the exponent of its opacity has the same two factors, and because it replaces many
// samples.
//
// 8. Compositing, relative per sample. The weight, a product, a sum and the transmittance
// contribute u each: 4u.
//
// 9. Precision fp64. The counts are the same with u = 2⁻⁵², because the kernels have the same
// source code. This is twice the unit roundoff of double, because the reference image is also
// computed in doubles and may have the same error as the device. There are three differences:
//   - The parameters are doubles and the eye is not rounded. The counts above cover this.
//   - tri_opacity is accurate to 12u, so the opacity has 12u + 4u + 2u = 18u.
//   - Output: each channel is rounded to float when it is stored, both in the image and in the
//     reference image, which adds 2·2⁻²⁴ of the channel. In fp32, compositing has already rounded
//     it.
[[nodiscard]] reference::ErrorModel error_model(const scene::VolumeScene& scene,
                                                const PathPrecision& path);

}  // namespace triptych::volume_suite
