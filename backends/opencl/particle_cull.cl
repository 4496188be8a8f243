// Cells in view, as a list that keeps their order: the test of cull.comp.glsl.

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
  // A pixel beyond the outermost ones, so that a sprite's margin is never cut.
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

// One work item per cell. visible[cell]: 1 where it is to be drawn.
__kernel void cull_cells(__global const Particles* parameters, __global const Cell* cells,
                         __global uint* visible, __global uint* counters) {
  uint cell = (uint)get_global_id(0);
  if (cell >= parameters->counts.y) return;
  Particles u = *parameters;
  int drawn = TRI_CULLING == 0 || !outside_view(&u, &cells[cell]) ? 1 : 0;
  visible[cell] = (uint)drawn;
#if TRI_COUNT
  counters[8 * cell + TRI_COUNT_CELLS_CULLED] = (uint)(1 - drawn);
  counters[8 * cell + TRI_COUNT_SUBMITTED] = drawn ? cells[cell].count : 0;
#endif
}

// One work item. list[0]: how many cells follow, in their order; of the cells to be drawn every
// stride-th.
__kernel void list_cells(__global const Particles* parameters, __global const uint* visible,
                         uint stride, __global uint* list) {
  uint seen = 0;
  uint listed = 0;
  for (uint cell = 0; cell < parameters->counts.y; ++cell) {
    if (visible[cell] == 0) continue;
    if (seen++ % stride == 0) list[++listed] = cell;
  }
  list[0] = listed;
}
