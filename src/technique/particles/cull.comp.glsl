// Include this after cull.glsl. Each invocation tests whether the box of one cell (a group of neighbouring particles,
// cells.glsl) intersects the view, and writes one draw command for the cell. The command of a culled cell is empty, so
// the other cells are always drawn in the same order. TRI_INSTANCED: 1 if each particle is an instance of four
// vertices, 0 if it is a single vertex.
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

void main() {
  uint index = gl_GlobalInvocationID.x;
  if (index >= u.counts.y) return;
  Cell cell = cells[index];
  commands[index] = command_for(cell, is_drawn(index, cell));
}
