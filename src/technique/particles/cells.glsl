// Declares the cells, which are groups of about 512 neighbouring particles (particles/arrangement.hpp), and tests
// whether a cell can be visible.
struct Cell {
  vec3 lo;
  uint begin;
  vec3 hi;
  uint count;
};
layout(std430) TRI_BINDING(6) readonly buffer Cells { Cell cells[]; };

// Returns whether the box is completely on the negative side of a plane through the eye, by more than the rounding
// error. Each product has a relative error of a few 2⁻²⁴, so 2⁻¹⁸ of the sum of their magnitudes covers all
// errors.
bool beyond(vec3 normal, vec3 lo, vec3 hi) {
  vec3 highest = max(normal * lo, normal * hi);
  vec3 size = max(abs(normal * lo), abs(normal * hi));
  return highest.x + highest.y + highest.z < -3.8e-6 * (size.x + size.y + size.z);
}

bool outside_view(Cell cell) {
  vec3 lo = cell.lo - u.eye.xyz;
  vec3 hi = cell.hi - u.eye.xyz;
  // Covers the rounding of the eye's position and one ulp of every coordinate.
  vec3 rounding = 2.4e-7 * max(abs(u.eye.xyz), max(abs(cell.lo), abs(cell.hi)));
  lo -= rounding;
  hi += rounding;
  // The view is extended by one pixel on each side, so that the margin of a sprite is never cut off.
  vec2 edge = u.forward.w * u.plane.xy + u.plane.zw;
  return beyond(u.forward.xyz, lo, hi) ||
         beyond(u.right.xyz + edge.x * u.forward.xyz, lo, hi) ||
         beyond(-u.right.xyz + edge.x * u.forward.xyz, lo, hi) ||
         beyond(u.up.xyz + edge.y * u.forward.xyz, lo, hi) ||
         beyond(-u.up.xyz + edge.y * u.forward.xyz, lo, hi);
}
