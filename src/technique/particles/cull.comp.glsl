// One invocation per cell: is any of its box in front of the eye and between the sides of the view? The
// answer is a draw command per cell, empty for a cell that is left out, so that the order of drawing stays
// the arrangement's. TRI_INSTANCED (0 or 1): a cell's particles are instances of four vertices, or vertices.
layout(local_size_x = 64) in;

struct Cell {
  vec3 lo;
  uint begin;
  vec3 hi;
  uint count;
};
layout(std430) TRI_BINDING(6) readonly buffer Cells { Cell cells[]; };

struct DrawCommand {
  uint vertices;
  uint instances;
  uint first_vertex;
  uint first_instance;
};
layout(std430) TRI_BINDING(7) writeonly buffer Commands { DrawCommand commands[]; };

// Whether the box lies wholly on the negative side of the plane through the eye, by more than rounding: a
// product errs by a few 2⁻²⁴ of its size, 2⁻¹⁸ covers all of them.
bool beyond(vec3 normal, vec3 lo, vec3 hi) {
  vec3 highest = max(normal * lo, normal * hi);
  vec3 size = max(abs(normal * lo), abs(normal * hi));
  return highest.x + highest.y + highest.z < -3.8e-6 * (size.x + size.y + size.z);
}

bool outside_view(Cell cell) {
  vec3 lo = cell.lo - u.eye.xyz;
  vec3 hi = cell.hi - u.eye.xyz;
  // The eye's own rounding, and a float's worth of every coordinate.
  vec3 rounding = 2.4e-7 * max(abs(u.eye.xyz), max(abs(cell.lo), abs(cell.hi)));
  lo -= rounding;
  hi += rounding;
  // A pixel beyond the outermost ones, so that a sprite's margin is never cut.
  vec2 edge = u.forward.w * u.plane.xy + u.plane.zw;
  return beyond(u.forward.xyz, lo, hi) ||
         beyond(u.right.xyz + edge.x * u.forward.xyz, lo, hi) ||
         beyond(-u.right.xyz + edge.x * u.forward.xyz, lo, hi) ||
         beyond(u.up.xyz + edge.y * u.forward.xyz, lo, hi) ||
         beyond(-u.up.xyz + edge.y * u.forward.xyz, lo, hi);
}

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
  bool drawn = !outside_view(cell);
  commands[index] = command_for(cell, drawn);
#if TRI_COUNT
  if (drawn) {
    add_count(TRI_COUNT_SUBMITTED, index, cell.count);
  } else {
    add_count(TRI_COUNT_CELLS_CULLED, index, 1u);
  }
#endif
}
