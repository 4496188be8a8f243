// Each invocation processes one cell (a group of neighbouring particles) of the current round, and writes the index at
// which the cell's particles end. If the cell is not drawn because it is outside the view (TRI_CULLING ≥ 1) or behind
// everything drawn so far (TRI_CULLING = 2), the invocation writes the index at which the cell's particles begin.
layout(local_size_x = 64) in;
layout(std430) TRI_BINDING(12) writeonly buffer CellEnds { uint cell_ends[]; };

// Returns whether the cell is behind everything drawn so far. The bounding sphere of the cell's box determines
// which tiles the cell may reach, and the box itself determines the cell's smallest distance.
bool behind_everything(Cell cell) {
  vec3 middle = 0.5 * (cell.lo + cell.hi);
  vec3 half_size = 0.5 * (cell.hi - cell.lo) + 2.4e-7 * max(abs(cell.lo), abs(cell.hi));
  vec4 around = camera_space(vec4(middle, 1.00001 * length(half_size)));
  ivec4 rectangle = pixel_rectangle(around);
  float near_side = around.z - dot(abs(u.forward.xyz), half_size);
  uint nearest = front_key(vec4(around.xy, near_side, 0.0));
  ivec2 first = rectangle.xy / TRI_TILE;
  ivec2 last = (rectangle.xy + rectangle.zw - 1) / TRI_TILE;
  ivec2 span = last - first + 1;
  const int most = 256;  // a cell that reaches more tiles is drawn without a test
  int count = rectangle.z > 0 ? span.x * span.y : 0;
  uint farthest = TRI_LARGEST_KEY;
  for (int i = 0; i < count && count <= most && farthest > nearest; ++i) {
    farthest = min(farthest, farthest_in(tile_index(first + ivec2(i % span.x, i / span.x))));
  }
  return count <= most && nearest < farthest;
}

void main() {
  uint n = gl_GlobalInvocationID.x;
  if (n >= TRI_ROUND.y) return;
  uint index = TRI_ROUND.x + n;
  Cell cell = cells[index];
  bool drawn = TRI_CULLING == 0 || !outside_view(cell);
  if (TRI_CULLING == 2 && drawn) drawn = !behind_everything(cell);
  cell_ends[index] = cell.begin + (drawn ? cell.count : 0u);
#if TRI_COUNT
  if (drawn) {
    add_count(TRI_COUNT_SUBMITTED, index, cell.count);
  } else {
    add_count(TRI_COUNT_CELLS_CULLED, index, 1u);
  }
#endif
}
