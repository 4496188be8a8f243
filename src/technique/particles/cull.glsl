// Include this after cells.glsl, and after occlusion.glsl if TRI_OCCLUSION is not 0. Particles are culled in groups
// called cells. With occlusion culling, a frame has two draws. TRI_OCCLUSION is 1 in the first draw, which draws the
// cells that were visible in the previous frame. TRI_OCCLUSION is 2 in the second draw, which draws the cells that have
// become visible since then and records which cells are visible in this frame. Without occlusion culling, TRI_OCCLUSION
// is 0 or undefined.
#ifndef TRI_OCCLUSION
#define TRI_OCCLUSION 0
#endif

// Returns whether the current draw includes the cell, and updates the counters.
bool is_drawn(uint index, Cell cell) {
  bool drawn = !outside_view(cell);
  bool left_out = !drawn;
#if TRI_OCCLUSION == 1
  drawn = drawn && visible_before[index] != 0u;
  left_out = false;  // the second draw decides whether the cell is culled
#elif TRI_OCCLUSION == 2
  bool drawn_before = drawn && visible_before[index] != 0u;
  bool shown = drawn && !hidden(cell);
  visible_now[index] = shown ? 1u : 0u;
  drawn = shown && !drawn_before;
  left_out = !shown && !drawn_before;
#endif
#if TRI_COUNT
  if (drawn) add_count(TRI_COUNT_SUBMITTED, index, cell.count);
  if (left_out) add_count(TRI_COUNT_CELLS_CULLED, index, 1u);
#endif
  return drawn;
}
