#pragma once
// How far a right picture may be from the truth, derived from what the arithmetic of a device may
// do. No number here was chosen by looking at an image.

#include "reference/spheres.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::particles_suite {

// u = 2⁻²⁴, the unit roundoff of float; every basic operation errs by at most u relative, a
// division by 2.5 ulp = 5u and a square root as much where an API allows it. W is the longer side
// in pixels.
//
// lateral, in pixels. sx = (x + ½)·pixel − half: the pixel's size is rounded (u of up to W pixels),
//   so is the product (u·W) and the half extent and the difference (u·W/2 each): 3u·W. The centre's
//   coordinates are right to u (tri_along_axis), a component of m = c × d adds a product and a
//   difference of terms within the image plane's extent at that depth: 3u·W/2. Two axes: × √2.
//   Together below 8u·W.
//   Where the ray is made at the vertices, they lie on the rasterizer's grid of g = 2⁻ᵇ pixel, so
//   that the interpolated ray is that of a point up to g/2 away per axis: g more, which leaves as
//   much as that again for the interpolation itself. Sprites cover what the grid moves
//   (technique/particles/margins.hpp), so that a ray made per pixel depends on no grid.
// lateral, relative to the radius. r²·q (3u + 2u) and |m|² (3 squares and 2 sums: 5u, halved by the
//   root) are compared: 5u·r.
// depth, relative to |C| + r. b = c·d: 3 products, 2 sums, 3u·|c||d|, and c's own u: 4u; root: the
//   discriminant's error is the lateral one, the root itself 5u; difference u, division 5u, q 3u;
//   near/Z 5u, and back u: below 24u.
// colour, of full scale. cosine = √(D/q)/r: divisions 5u + 5u, root 5u, q 2u; light: product, sum,
//   2u; the stored colour: byte/255 5u or table (3u of value, 3u of position·256 steps ≤ full
//   scale, times its slope, covered by the 256·u below); product u: 32u, and 256u more for
//   intensity.
[[nodiscard]] reference::SphereErrorModel error_model(const scene::ParticleScene& scene,
                                                      technique::ComputedAt ray,
                                                      int sub_pixel_bits = 8);

}  // namespace triptych::particles_suite
