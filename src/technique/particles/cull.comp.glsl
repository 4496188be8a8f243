// After cells.glsl. One invocation per cell: is any of its box in front of the eye and between the sides of the view? The
// answer is a draw command per cell, empty for a cell that is left out, so that the order of drawing stays
// the arrangement's. TRI_INSTANCED (0 or 1): a cell's particles are instances of four vertices, or vertices.
layout(local_size_x = 64) in;

struct DrawCommand {
  uint vertices;
  uint instances;
  uint first_vertex;
  uint first_instance;
};
layout(std430) TRI_BINDING(7) writeonly buffer Commands { DrawCommand commands[]; };

DrawCommand command_for(Cell cell, bool drawn) {
  uint count = drawn ? cell.count : 0u;
#if TRI_INSTANCED
  return DrawCommand(4u, count, 0u, cell.begin);
#else
  return DrawCommand(count, 1u, cell.begin, 0u);
#endif
}

#ifndef TRI_OCCLUSION
#define TRI_OCCLUSION 0
#endif
// TRI_OCCLUSION, which needs occlusion.glsl: 1, a frame's first draw, of what the last frame showed; 2, its
// second, of what came into sight since then, noting what this frame shows. 0 or not defined: neither.
void main() {
  uint index = gl_GlobalInvocationID.x;
  if (index >= u.counts.y) return;
  Cell cell = cells[index];
  bool drawn = !outside_view(cell);
  bool left_out = !drawn;
#if TRI_OCCLUSION == 1
  drawn = drawn && visible_before[index] != 0u;
  left_out = false;  // the second draw decides
#elif TRI_OCCLUSION == 2
  bool drawn_before = drawn && visible_before[index] != 0u;
  bool shown = drawn && !hidden(cell);
  visible_now[index] = shown ? 1u : 0u;
  drawn = shown && !drawn_before;
  left_out = !shown && !drawn_before;
#endif
  commands[index] = command_for(cell, drawn);
#if TRI_COUNT
  if (drawn) add_count(TRI_COUNT_SUBMITTED, index, cell.count);
  if (left_out) add_count(TRI_COUNT_CELLS_CULLED, index, 1u);
#endif
}
