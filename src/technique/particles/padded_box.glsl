// Computes the box of a sphere for an acceleration structure. Include this after sphere_box.glsl. The driver traverses
// the structure with rays and boxes in single precision, and no specification defines how its arithmetic rounds. The
// box must contain every point that the intersection test for the sphere can report. With u = 2⁻²⁴, and for a sphere
// with centre c and radius r, the box is therefore larger than the sphere by
//   2⁻¹⁹·(|eye| + |c| + r)·l  for the rounding of the eye and of the ray's direction (u times the distance in each
//                             component), for the driver's differences and divisions (a few u more), and for the
//                             error in the distance of a hit, 24u·(|c| + r). That error is along the view axis,
//                             so the factor l is needed, an upper bound on the ray's length per unit of depth.
//   1/64 pixel                the margin of sprites, which covers single-precision hits outside the silhouette
void padded_box(vec4 sphere, out vec3 lo, out vec3 hi) {
  sphere_box(sphere, lo, hi);
  vec3 to = sphere.xyz - u.eye.xyz;
  float reach = length(u.eye.xyz) + length(sphere.xyz) + sphere.w;
  float longest = 1.0 + u.plane.x + u.plane.y;
  float pad = 1.9e-6 * reach * longest + 0.015625 * max(u.plane.z, u.plane.w) * (length(to) + sphere.w);
  lo -= pad;
  hi += pad;
}
