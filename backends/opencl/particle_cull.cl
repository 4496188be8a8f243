// Creates an ordered list of the visible cells (ranges of neighbouring particles), with the same
// test as cull.comp.glsl.

TRI_FN bool beyond(float nx, float ny, float nz, const float* lo, const float* hi) {
  float lx = nx * lo[0], hx = nx * hi[0];
  float ly = ny * lo[1], hy = ny * hi[1];
  float lz = nz * lo[2], hz = nz * hi[2];
  float highest = max(lx, hx) + max(ly, hy) + max(lz, hz);
  float size = max(fabs(lx), fabs(hx)) + max(fabs(ly), fabs(hy)) + max(fabs(lz), fabs(hz));
  return highest < -3.8e-6f * size;  // by more than rounding
}

TRI_FN bool outside_view(const Particles* u, const __global Cell* cell) {
  float eye[3] = {u->eye.x, u->eye.y, u->eye.z};
  float lo[3];
  float hi[3];
  for (int k = 0; k < 3; ++k) {
    float rounding = 2.4e-7f * max(fabs(eye[k]), max(fabs(cell->lo[k]), fabs(cell->hi[k])));
    lo[k] = cell->lo[k] - eye[k] - rounding;
    hi[k] = cell->hi[k] - eye[k] + rounding;
  }
  // The view is extended by one pixel on each side, so that the margin of a sprite is never cut
  // off.
  float edge_x = u->forward.w * u->plane.x + u->plane.z;
  float edge_y = u->forward.w * u->plane.y + u->plane.w;
  float3 f = u->forward.xyz;
  float3 x = u->right.xyz;
  float3 y = u->up.xyz;
  float3 xf = edge_x * f;
  float3 yf = edge_y * f;
  return beyond(f.x, f.y, f.z, lo, hi) ||
         beyond(xf.x + x.x, xf.y + x.y, xf.z + x.z, lo, hi) ||
         beyond(xf.x - x.x, xf.y - x.y, xf.z - x.z, lo, hi) ||
         beyond(yf.x + y.x, yf.y + y.y, yf.z + y.z, lo, hi) ||
         beyond(yf.x - y.x, yf.y - y.y, yf.z - y.z, lo, hi);
}

// The state of a cell in the current frame.
#define TRI_NOT_DRAWN 0u
#define TRI_DRAWN_FIRST 1u
#define TRI_DRAWN_LATER 2u  // became visible since the previous frame
#define TRI_TO_BE_TESTED 3u

// Runs one work item per cell. If `culling` is 0, cells outside of the view are drawn as well.
// shown[cell] is 1 if the cell was visible in the previous frame.
__kernel void cull_cells(__global const Particles* parameters, __global const Cell* cells,
                         uint culling, __global const uint* shown, __global uint* states,
                         __global uint* counters) {
  uint cell = (uint)get_global_id(0);
  if (cell >= parameters->counts.y) return;
  Particles u = *parameters;
  uint state = shown[cell] ? TRI_DRAWN_FIRST : TRI_TO_BE_TESTED;
  if (culling != 0 && outside_view(&u, &cells[cell])) state = TRI_NOT_DRAWN;
  states[cell] = state;
#if TRI_COUNT
  bool drawn = state == TRI_DRAWN_FIRST;
  counters[8 * cell + TRI_COUNT_CELLS_CULLED] = drawn ? 0 : 1;
  counters[8 * cell + TRI_COUNT_SUBMITTED] = drawn ? cells[cell].count : 0;
#endif
}

// Computes the position of the box on the screen: its smallest distance along the view axis, and
// its first and last pixel, extended by one pixel on each side for round-off. Returns false if a
// part of the box is not in front of the eye.
TRI_FN bool box_on_screen(const Particles* u, const __global Cell* cell, float* nearest,
                          int4* pixels) {
  float size = 0.0f;
  for (int k = 0; k < 3; ++k) size = max(size, max(fabs(cell->lo[k]), fabs(cell->hi[k])));
  size += fabs(u->eye.x) + fabs(u->eye.y) + fabs(u->eye.z);
  float2 low = (float2)(INFINITY, INFINITY);
  float2 high = -low;
  *nearest = INFINITY;
  for (int corner = 0; corner < 8; ++corner) {
    float x = (corner & 1) != 0 ? cell->hi[0] : cell->lo[0];
    float y = (corner & 2) != 0 ? cell->hi[1] : cell->lo[1];
    float z = (corner & 4) != 0 ? cell->hi[2] : cell->lo[2];
    float distance = camera_z(u, x, y, z);
    if (distance <= 1e-5f * size) return false;
    float2 at = (float2)(camera_x(u, x, y, z), 0.0f - camera_y(u, x, y, z)) / distance;
    *nearest = min(*nearest, distance - 1e-6f * size);
    low = (float2)(min(low.x, at.x), min(low.y, at.y));
    high = (float2)(max(high.x, at.x), max(high.y, at.y));
  }
  *pixels = (int4)(first_pixel(low.x, u->plane.x, u->plane.z, u->viewport.x) - 1,
                   first_pixel(low.y, u->plane.y, u->plane.w, u->viewport.y) - 1,
                   last_pixel(high.x, u->plane.x, u->plane.z, u->viewport.x) + 1,
                   last_pixel(high.y, u->plane.y, u->plane.w, u->viewport.y) + 1);
  return true;
}

// Returns whether everything in the box lies strictly behind the farthest depth of every tile that
// the box overlaps. `farthest` contains one reversed depth per tile; it is 0 if any of the tile's
// pixels is empty.
TRI_FN bool occluded(const Particles* u, const __global Cell* cell,
                     __global const float* restrict farthest) {
  float nearest;
  int4 pixels;
  if (!box_on_screen(u, cell, &nearest, &pixels)) return false;
  float depth = u->eye.w / nearest;
  int across = tiles_across(u);
  int x0 = max(pixels.x, 0) >> TRI_TILE_SHIFT;
  int y0 = max(pixels.y, 0) >> TRI_TILE_SHIFT;
  int x1 = min(pixels.z, u->viewport.x - 1) >> TRI_TILE_SHIFT;
  int y1 = min(pixels.w, u->viewport.y - 1) >> TRI_TILE_SHIFT;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      if (depth >= farthest[y * across + x]) return false;
    }
  }
  return true;
}

// Runs one work item per cell after the first pass. Finds out which cells in the view are visible,
// and which of these still have to be drawn.
__kernel void test_cells(__global const Particles* parameters, __global const Cell* cells,
                         __global const float* restrict farthest, __global uint* shown,
                         __global uint* states, __global uint* counters) {
  uint cell = (uint)get_global_id(0);
  if (cell >= parameters->counts.y) return;
  Particles u = *parameters;
  uint state = states[cell];
  bool in_sight = state != TRI_NOT_DRAWN && !occluded(&u, &cells[cell], farthest);
  shown[cell] = in_sight ? 1 : 0;
  if (state != TRI_TO_BE_TESTED) return;
  states[cell] = in_sight ? TRI_DRAWN_LATER : TRI_NOT_DRAWN;
#if TRI_COUNT
  counters[8 * cell + TRI_COUNT_CELLS_CULLED] = in_sight ? 0 : 1;
  counters[8 * cell + TRI_COUNT_SUBMITTED] = in_sight ? cells[cell].count : 0;
#endif
}

// Runs a single work item. Writes every stride-th of the cells that have this state, in order,
// beginning at list[1]. list[0] is the number of cells in the list.
__kernel void list_cells(__global const Particles* parameters, __global const uint* states,
                         uint state, uint stride, __global uint* list) {
  uint seen = 0;
  uint listed = 0;
  for (uint cell = 0; cell < parameters->counts.y; ++cell) {
    if (states[cell] != state) continue;
    if (seen++ % stride == 0) list[++listed] = cell;
  }
  list[0] = listed;
}
