// Include this after cull.glsl. One invocation for each cell tests whether any part of its box is in front of the
// eye and between the sides of the view. It writes one draw command for each cell. A culled cell gets an empty
// command, so that cells are drawn in the order of the arrangement. TRI_INSTANCED: 1 if the particles of a cell are
// instances of four vertices, 0 if they are vertices.
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
