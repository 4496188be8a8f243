// Include this after cells.glsl. Finds the cells (groups of particles) that are hidden in an image into which some of
// the cells have already been drawn. To do so, each cell is compared with the farthest depth in each block of 16×16
// pixels. Depth is reversed, so the farthest depth is the smallest value.
layout(std430) TRI_BINDING(8) readonly buffer VisibleBefore { uint visible_before[]; };  // in the previous frame
layout(std430) TRI_BINDING(9) writeonly buffer VisibleNow { uint visible_now[]; };
layout(std430) TRI_BINDING(10) readonly buffer Farthest { uint farthest[]; };  // farthest depth per block, as a bit pattern

// Returns whether the cell is hidden. The bounding sphere of the cell's box determines which blocks the cell may
// reach, and the box itself determines the cell's smallest distance. A hidden cell is strictly behind everything
// visible in these blocks, so it could not win a depth tie either.
bool hidden(Cell cell) {
  vec3 middle = 0.5 * (cell.lo + cell.hi);
  vec3 half_size = 0.5 * (cell.hi - cell.lo) + 2.4e-7 * max(abs(cell.lo), abs(cell.hi));
  vec4 around = camera_space(vec4(middle, 1.00001 * length(half_size)));
  // Depths computed on a device have an error of a few 2⁻²⁴ of the distance to the farthest part of the sphere, so
  // 2⁻¹⁶ is more than enough.
  float rounding = 1.5259e-5 * (abs(around.x) + abs(around.y) + abs(around.z) + around.w);
  float front = around.z - dot(abs(u.forward.xyz), half_size) - rounding;
  vec2 low;
  vec2 high;
  image_bounds(around, low, high);
  if (front <= u.eye.w || low.x > high.x || low.y > high.y) return false;
  // The ray of pixel (x, y) passes through the point ((x + ½)·plane.z − plane.x, plane.y − (y + ½)·plane.w) of the
  // image plane. One pixel is added on each side.
  vec2 first = vec2(low.x + u.plane.x, u.plane.y - high.y) / u.plane.zw - 1.5;
  vec2 last = vec2(high.x + u.plane.x, u.plane.y - low.y) / u.plane.zw + 0.5;
  ivec2 begin = ivec2(clamp(first, vec2(0.0), vec2(u.viewport.xy - 1))) / 16;
  ivec2 end = ivec2(clamp(last, vec2(0.0), vec2(u.viewport.xy - 1))) / 16;
  int columns = (u.viewport.x + 15) / 16;
  ivec2 span = end - begin + 1;
  const int most = 1024;  // a cell that reaches more blocks is drawn without a test
  int count = span.x * span.y;
  uint nearest = floatBitsToUint(tri_depth(u.eye.w, front));
  bool behind = count <= most;
  for (int i = 0; i < count && behind; ++i) {
    ivec2 block = begin + ivec2(i % span.x, i / span.x);
    behind = nearest < farthest[block.y * columns + block.x];
  }
  return behind;
}
