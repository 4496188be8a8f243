// The box of a sphere for an acceleration structure, whose traversal is the driver's: rays and boxes in single precision,
// and no promise of how its arithmetic rounds. After sphere_box.glsl. The box has to hold all that the sphere's own test
// can hit, so it is wider by
//   2⁻¹⁹·(|eye| + |c| + r)  for the rounding of the eye and of the ray's direction (each u of the distance a component),
//                           the driver's differences and divisions (a few u more), and the 24u·(|c| + r) by which the
//                           distance of a hit may err: that is along the view axis, so times the ray's length there
//   1/64 pixel              as sprites are: what single precision hits beside the silhouette
void padded_box(vec4 sphere, out vec3 lo, out vec3 hi) {
  sphere_box(sphere, lo, hi);
  vec3 to = sphere.xyz - u.eye.xyz;
  float reach = length(u.eye.xyz) + length(sphere.xyz) + sphere.w;
  float longest = 1.0 + u.plane.x + u.plane.y;
  float pad = 1.9e-6 * reach * longest + 0.015625 * max(u.plane.z, u.plane.w) * (length(to) + sphere.w);
  lo -= pad;
  hi += pad;
}
