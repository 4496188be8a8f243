#pragma once
// The largest difference from the reference image that a correct image may have. It is derived from
// the arithmetic of a device. No number here was chosen by looking at an image.

#include "reference/spheres.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::particles_suite {

// The error model counts roundings. u = 2⁻²⁴ is the unit roundoff of float. Every basic operation
// has a relative error of at most u; a division has 2.5 ulp = 5u, and a square root the same, where
// the API allows it. W is the longer side of the image in pixels.
//
// Lateral, in pixels.
//   - sx = (x + ½)·pixel − half: rounding the pixel's size moves a point by up to u·W, the product
//     by u·W, the half extent and the difference by u·W/2 each: 3u·W.
//   - The centre's coordinates are accurate to u (tri_along_axis). A component of m = c × d adds a
//     product and a difference of terms within the image plane's extent at that depth: 3u·W/2.
//   - For two axes this is multiplied by √2. Together below 8u·W.
//   - If the ray is computed at the vertices, they lie on the rasterizer's grid of g = 2⁻ᵇ pixel.
//     The interpolated ray is then that of a point up to g/2 away per axis. Adding g leaves as much
//     again for the interpolation itself. Sprites cover what the grid moves
//     (technique/particles/margins.hpp), so that a ray computed per pixel depends on no grid.
//
// Lateral, relative to the radius. r²·q (3u + 2u) is compared with |m|² (3 squares and 2 sums, 5u,
// halved by the root): 5u·r.
//
// Depth, relative to |C| + r.
//   - b = c·d has 3 products and 2 sums, 3u·|c||d|, and c has u itself: 4u.
//   - Root: the discriminant's error is the lateral one; the root itself has 5u.
//   - The difference has u, the division 5u, q 3u, near/Z 5u, and the way back u. Together below
//     24u.
//
// Colour, relative to full scale.
//   - cosine = √(D/q)/r: two divisions 5u + 5u, root 5u, q 2u.
//   - Light: product and sum, 2u.
//   - The stored colour: byte/255 has 5u. From a table it has 3u of the value and 3u of
//     position·256, times the table's slope, which the 256u below cover.
//   - The final product has u. Together 32u, and 256u more for an intensity.
[[nodiscard]] reference::SphereErrorModel error_model(const scene::ParticleScene& scene,
                                                      technique::ComputedAt ray,
                                                      int sub_pixel_bits = 8);

}  // namespace triptych::particles_suite
