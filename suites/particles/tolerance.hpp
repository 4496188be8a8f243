#pragma once
// Derives how much the image of a correct device may differ from the reference image. All numbers
// follow from counting the rounding errors of the device's arithmetic. None was tuned by looking at
// images.

#include "reference/spheres.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::particles_suite {

// The error model counts roundings. u = 2⁻²⁴ is the unit roundoff of float. Every basic operation
// has a relative error of at most u. APIs allow division and square root to be less precise: 2.5
// ulp = 5u. W is the longer side of the image in pixels. The notation is that of
// technique/portable/sphere_math.h: the ray has the direction d = (sx, sy, 1) with q = |d|², the
// sphere has the centre c (in camera space) and the radius r, and m = c × d.
//
// 1. Lateral error of the ray, in pixels.
//   - sx = (x + ½)·pixel − half. Rounding `pixel`, the size of a pixel, moves a point by up to u·W;
//     the product adds another u·W, and `half` (half the extent of the image) and the difference
//     add u·W/2 each. The sum is 3u·W.
//   - The coordinates of c are accurate to u (tri_along_axis). Each component of m = c × d adds the
//     roundings of a product and of a difference. Their terms are at most half the extent of the
//     image at that depth, so the three errors sum up to 3u·W/2.
//   - The error in two axes is √2 times as large. The total is below 8u·W.
//   - Rays that are computed at vertices and interpolated have an additional error, because
//     vertices are snapped to the rasterizer's grid of g = 2⁻ⁿ pixel, where n is the number of
//     sub-pixel bits. The interpolated ray is the ray of a point that is up to g/2 away along each
//     axis. The model adds g, of which the other half is for the interpolation itself. Rays that
//     are computed per pixel do not depend on the grid, because sprites are large enough to allow
//     for snapping (margins.hpp).
//
// 2. Lateral error, relative to the radius. A ray hits if |m|² ≤ r²·q. The right side has an error
// of 5u (3u from q and 2u from two products), and so has the left side (three squares and two
// sums). The square root halves their sum: 5u·r.
//
// 3. Error of the depth, relative to |c| + r.
//   - The depth is (b − √D)/q. Here, b = c·d consists of 3 products and 2 sums, 3u·|c||d|. The
//     error of c adds u: 4u.
//   - The error of the discriminant D = r²·q − |m|² is the lateral error above. Taking the square
//     root √D adds 5u.
//   - The difference b − √D adds u, the division by q adds 5u, and q itself 3u. The depth is stored
//     as near/Z, where Z is the distance along the view axis, and `near` is the distance of the
//     near plane. This adds 5u, and the conversion back to a distance adds u. The total is 24u.
//
// 4. Error of the colour, relative to full scale.
//   - cosine = √(D/q)/r: 5u for each of the two divisions, 5u for the square root, and 2u from q.
//   - Light: a product and a sum, 2u.
//   - The particle's colour: byte/255 has an error of 5u. A colour from the transfer function has
//     3u from the interpolation. Its position in the table, 256·x − ½, is rounded once, which moves
//     it by up to 256u entries. The colour changes by at most 1 per entry, so this adds 256u.
//   - The product of light and colour adds u. The total is below 32u, or below 32u + 256u for an
//     intensity.
[[nodiscard]] reference::SphereErrorModel error_model(const scene::ParticleScene& scene,
                                                      technique::ComputedAt ray,
                                                      int sub_pixel_bits = 8);

}  // namespace triptych::particles_suite
